"""Show the robot in RViz, its leg moved by a slider: ros2 launch @PACKAGE@ view_robot.launch.py"""

import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.substitutions import Command
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description():
    share = get_package_share_directory("@PACKAGE@")
    model = os.path.join(share, "urdf", "@MODEL@.urdf.xacro")
    description = ParameterValue(Command(['xacro "', model, '"']), value_type=str)
    return LaunchDescription(
        [
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[{"robot_description": description}],
            ),
            Node(package="joint_state_publisher_gui", executable="joint_state_publisher_gui"),
            Node(package="rviz2", executable="rviz2", arguments=["-d", os.path.join(share, "rviz", "view.rviz")]),
        ]
    )
