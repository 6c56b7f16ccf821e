"""URDF files from strangers: what is no robot is refused in one line, and the engines go on working."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from xml.etree import ElementTree

from support.each import each
from support.mutations import DOCUMENTS, NESTED, NO_NUMBERS, NUMBERS, Spoil, accidents
from support.sandbox import ANY, Sandbox

from hostile.conftest import ENGINES, Originals

ATTRIBUTES = {
    "mass": (".//mass", "value", "{}"),
    "ixx": (".//inertia", "ixx", "{}"),
    "iyy": (".//inertia", "iyy", "{}"),
    "izz": (".//inertia", "izz", "{}"),
    "ixz": (".//inertia", "ixz", "{}"),
    "centre-of-mass": (".//inertial/origin", "xyz", "{} 0 0"),
    "inertial-turn": (".//inertial/origin", "rpy", "0 {} 0"),
    "joint-place": (".//joint/origin", "xyz", "0 0 {}"),
    "joint-turn": (".//joint/origin", "rpy", "0 {} 0"),
    "sphere-place": (".//collision/origin", "xyz", "{} 0 0"),
    "radius": (".//sphere", "radius", "{}"),
    "effort": (".//limit", "effort", "{}"),
}
POSITIVE = ("mass", "ixx", "iyy", "izz", "radius")
"""What has no meaning at zero or below."""
SHAPELESS = {("mass", "huge"), ("ixx", "huge"), ("iyy", "huge"), ("izz", "huge"), ("ixz", "huge")}
"""Bodies that break the triangle rule of moments, or outweigh the Earth."""
NEEDED = ("inertial", "mass", "inertia", "collision/geometry", "collision/geometry/sphere", "limit", "parent", "child")
TAIL = """<link name="tail"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>"""
LAUGHS = "".join(f'<!ENTITY l{n} "{f"&l{n - 1};" * 10}">' for n in range(1, 10))


@dataclass(frozen=True)
class Case:
    """What is done to the text of a URDF file, and the exit codes that are right."""

    change: Spoil
    exits: tuple[int, ...] = ANY


def tree(change: Callable[[ElementTree.Element], object]) -> Spoil:
    """Return a change of the elements of a URDF file as a change of its text."""

    def spoil(data: bytes) -> bytes:
        root = ElementTree.fromstring(data)
        change(root)
        return ElementTree.tostring(root)

    return spoil


def setting(path: str, attribute: str, value: str) -> Spoil:
    return tree(lambda root: found(root, path).set(attribute, value))


def found(root: ElementTree.Element, path: str) -> ElementTree.Element:
    element = root.find(path)
    assert element is not None
    return element


def without(path: str) -> Spoil:
    """Return the removal of the first element at a path below a link or a joint."""
    parent, _, name = path.rpartition("/")
    above = f".//{parent}" if parent else "link" if path in ("inertial", "collision") else f".//{name}/.."
    return tree(lambda root: found(root, above).remove(found(found(root, above), name)))


def without_attribute(path: str, attribute: str) -> Spoil:
    return tree(lambda root: found(root, path).attrib.pop(attribute))


def without_all(name: str) -> Spoil:
    return tree(lambda root: [root.remove(element) for element in root.findall(name)])


def with_more(text: str) -> Spoil:
    return tree(lambda root: root.append(ElementTree.fromstring(text)))


def with_head(head: str) -> Spoil:
    return lambda data: head.encode() + re.sub(rb"^<\?xml.*?\?>", b"", data)


def named(name: str) -> Spoil:
    """Return the change of the robot's name, as it stands in XML."""
    return lambda data: data.replace(b'<robot name="kenan-2.0"', f'<robot name="{name}"'.encode("latin-1"))


def wrong_number(attribute: str, number: str) -> bool:
    return number in NO_NUMBERS or (attribute in POSITIVE and number in ("zero", "minus", "tiny"))


VALUES = {
    f"{attribute}-{number}": Case(
        setting(path, name, form.format(value)),
        (2,) if wrong_number(attribute, number) or (attribute, number) in SHAPELESS else ANY,
    )
    for attribute, (path, name, form) in ATTRIBUTES.items()
    for number, value in NUMBERS.items()
}
STRUCTURES = {f"no-{path.replace('/', '-')}": Case(without(path), (2,)) for path in NEEDED} | {
    "no-joints": Case(without_all("joint"), (2,)),
    "no-links": Case(without_all("link"), (2,)),
    "no-mass-value": Case(without_attribute(".//mass", "value"), (2,)),
    "no-ixx": Case(without_attribute(".//inertia", "ixx"), (2,)),
    "no-collision-name": Case(without_attribute(".//collision", "name"), (2,)),
    "no-link-name": Case(without_attribute(".//link", "name"), (2,)),
    "no-joint-name": Case(without_attribute(".//joint", "name"), (2,)),
    "no-radius": Case(without_attribute(".//sphere", "radius"), (2,)),
    "no-robot-name": Case(without_attribute(".", "name")),
    "no-axis": Case(without("axis")),
    "fixed-joint": Case(setting(".//joint", "type", "fixed"), (2,)),
    "sliding-joint": Case(setting(".//joint", "type", "prismatic"), (2,)),
    "floating-joint": Case(setting(".//joint", "type", "floating"), (2,)),
    "unknown-joint": Case(setting(".//joint", "type", "rubber"), (2,)),
    "axis-nan": Case(setting(".//axis", "xyz", "nan 1 0"), (2,)),
    "axis-nowhere": Case(setting(".//axis", "xyz", "0 0 0"), (2,)),
    "axis-forwards": Case(setting(".//axis", "xyz", "1 0 0"), (2,)),
    "child-of-itself": Case(setting(".//joint/parent", "link", "main_leg"), (2,)),
    "parent-unknown": Case(setting(".//joint/parent", "link", "nobody"), (2,)),
    "child-unknown": Case(setting(".//joint/child", "link", "nobody"), (2,)),
    "child-of-two": Case(setting(".//joint/child", "link", "foot"), (2,)),
    "link-renamed": Case(setting(".//link[@name='foot']", "name", "hand"), (2,)),
    "joint-renamed": Case(setting(".//joint[@name='leg']", "name", "arm"), (2,)),
    "joint-twice": Case(setting(".//joint[@name='leg']", "name", "front"), (2,)),
    "link-twice": Case(setting(".//link[@name='foot']", "name", "body"), (2,)),
    "fifth-link": Case(with_more('<link name="tail"/>'), (2,)),
    "fifth-link-whole": Case(with_more(TAIL), (2,)),
    "many-links": Case(tree(lambda root: root.extend(ElementTree.Element("link", name=f"l{n}") for n in range(3000)))),
    "many-spheres": Case(tree(lambda root: found(root, "link").extend([found(root, ".//collision")] * 3000))),
    "box-for-sphere": Case(tree(lambda root: setattr(found(root, ".//sphere"), "tag", "box")), (2,)),
    "another-root": Case(tree(lambda root: setattr(root, "tag", "sdf")), (2,)),
    "mesh-elsewhere": Case(setting(".//mesh", "filename", "../../home/.bashrc")),
    "mesh-absolute": Case(setting(".//mesh", "filename", "/dev/zero")),
    "mesh-on-the-net": Case(setting(".//mesh", "filename", "https://127.0.0.1:1/x.stl")),
    "nested": Case(lambda data: data.replace(b"</robot>", b"<a>" * NESTED + b"</a>" * NESTED + b"</robot>")),
    "nested-far": Case(lambda data: data.replace(b"</robot>", b"<a>" * 100_000 + b"</a>" * 100_000 + b"</robot>")),
    "laughs": Case(with_head(f'<!DOCTYPE robot [<!ENTITY l0 "ha">{LAUGHS}]>')),
    "laughs-told": Case(
        lambda data: named("&l9;")(with_head(f'<!DOCTYPE robot [<!ENTITY l0 "ha">{LAUGHS}]>')(data)), (2,)
    ),
    "declared-utf-7": Case(with_head('<?xml version="1.0" encoding="utf-7"?>')),
    "declared-nonsense": Case(with_head('<?xml version="1.0" encoding="klingon"?>'), (2,)),
}  # fmt: skip
NAMES = {
    "path": "../../report",
    "absolute": "/dev/null",
    "line": "a&#10;b",
    "tab": "a&#9;b",
    "control": "a&#27;[31mb",
    "markup": "[/x]",
    "formula": "=1+1",
    "long": "x" * 100_000,
    "empty": "",
}
CASES = (
    VALUES
    | STRUCTURES
    | {f"named-{name}": Case(named(text)) for name, text in NAMES.items()}
    | {name: Case(change) for name, change in (DOCUMENTS | accidents(flips=24, cuts=8)).items()}
)


@each("case", CASES)
def test_a_strangers_urdf_is_a_robot_or_is_refused(
    sandbox: Sandbox, originals: Originals, still_works: Callable[[str], None], case: str
) -> None:
    engine = ENGINES[list(CASES).index(case) % len(ENGINES)]
    originals.lay_urdf(sandbox, CASES[case].change(originals.urdf))
    try:
        sandbox.run("simulate", "robot.urdf", "--json", "--engine", engine, exits=CASES[case].exits)
    finally:
        still_works(engine)


def test_an_entity_does_not_read_a_file(sandbox: Sandbox, originals: Originals) -> None:
    secret = sandbox.write(sandbox.home / "secret", "5up3r-s3cr3t")
    text = with_head(f'<!DOCTYPE robot [<!ENTITY x SYSTEM "{secret.as_uri()}">]>')(originals.urdf)
    text = re.sub(rb'(<link name="body">)', rb"\1<verbatim>&x;</verbatim>", text)
    originals.lay_urdf(sandbox, text.replace(b'value="0.', b'value="&x;0.', 1))
    done = sandbox.run("simulate", "robot.urdf", "--json")
    assert "s3cr3t" not in done.out + done.err
