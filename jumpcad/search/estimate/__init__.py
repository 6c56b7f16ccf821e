"""What is known of a robot before it is built: its layout exactly, its masses and its jump about."""
