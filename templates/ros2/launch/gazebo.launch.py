"""Put the robot into Gazebo with ros2_control: ros2 launch @PACKAGE@ gazebo.launch.py"""

import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription, SetEnvironmentVariable
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

HEIGHT_M, PITCH_RAD = "@HEIGHT_M@", "@PITCH_RAD@"  # of base_link, springs at rest


def generate_launch_description():
    share = get_package_share_directory("@PACKAGE@")
    gazebo = os.path.join(get_package_share_directory("ros_gz_sim"), "launch", "gz_sim.launch.py")
    model = os.path.join(share, "urdf", "@MODEL@.urdf.xacro")
    controllers = os.path.join(share, "config", "controllers.yaml")
    command = Command(['xacro "', model, '" gazebo:=true mimic:=false "controllers:=', controllers, '"'])
    description = ParameterValue(command, value_type=str)
    spawners = [
        Node(package="controller_manager", executable="spawner", arguments=[name])
        for name in ("joint_state_broadcaster", "cam@WHEEL@", "steer@END@")
    ]
    return LaunchDescription(
        [
            SetEnvironmentVariable("GZ_SIM_RESOURCE_PATH", os.path.dirname(share)),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(gazebo), launch_arguments={"gz_args": "-r empty.sdf"}.items()
            ),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[{"robot_description": description, "use_sim_time": True}],
            ),
            Node(
                package="ros_gz_sim",
                executable="create",
                arguments=["-topic", "robot_description", "-z", HEIGHT_M, "-P", PITCH_RAD],
            ),
            Node(
                package="ros_gz_bridge",
                executable="parameter_bridge",
                arguments=["/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock"],
            ),
            *spawners,
        ]
    )
