"""The planar five-bar: linkage, bodies, joints, loop and springs as plain data, feasibility, the study's capsules."""
