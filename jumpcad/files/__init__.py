"""Files of users: read with errors that name file, line, key, value and limit; written whole or not at all."""

from jumpcad.files.complaints import did_you_mean
from jumpcad.files.reading import read_bytes, read_json, read_text, read_toml, real_path, to_toml
from jumpcad.files.records import Contradiction, Record, TomlTable
from jumpcad.files.templates import find_template, template_names, templates_folder

__all__ = [
    "Contradiction",
    "Record",
    "TomlTable",
    "did_you_mean",
    "find_template",
    "read_bytes",
    "read_json",
    "read_text",
    "read_toml",
    "real_path",
    "template_names",
    "templates_folder",
    "to_toml",
]
