"""The robust pick: of the best designs, the one whose neighbours jump well too."""
