"""Files of users: read with errors that name file, line, key, value and limit; written whole or not at all.

The public names load when they are first used: the command line's help needs no validated records.
"""

from typing import TYPE_CHECKING

from jumpcad.face import lazy_exports

if TYPE_CHECKING:
    from jumpcad.files.complaints import did_you_mean as did_you_mean
    from jumpcad.files.reading import read_bytes as read_bytes
    from jumpcad.files.reading import read_json as read_json
    from jumpcad.files.reading import read_text as read_text
    from jumpcad.files.reading import read_toml as read_toml
    from jumpcad.files.reading import to_toml as to_toml
    from jumpcad.files.records import Contradiction as Contradiction
    from jumpcad.files.records import Record as Record
    from jumpcad.files.records import TomlTable as TomlTable
    from jumpcad.files.templates import find_template as find_template
    from jumpcad.files.templates import template_names as template_names
    from jumpcad.files.templates import templates_folder as templates_folder
else:
    __getattr__, __dir__, __all__ = lazy_exports(__name__, {
        "jumpcad.files.complaints": "did_you_mean",
        "jumpcad.files.reading": "read_bytes read_json read_text read_toml to_toml",
        "jumpcad.files.records": "Contradiction Record TomlTable",
        "jumpcad.files.templates": "find_template template_names templates_folder",
    })  # fmt: skip
