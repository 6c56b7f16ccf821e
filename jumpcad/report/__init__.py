"""What people see of robots and searches: pictures and pages."""
