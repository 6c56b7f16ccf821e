"""The guide: how to order, check, wire, assemble and unload a robot. Words are in `templates/guides`, figures here."""
