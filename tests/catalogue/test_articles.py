"""Articles of the catalogue: rules that every motor, bearing, battery and board keeps."""

from jumpcad.catalogue import load_catalogue


def test_shipped_parts_keep_the_rules_of_own_ones() -> None:
    shipped = load_catalogue()
    parts = [
        *shipped.motors.values(),
        *shipped.bearings.values(),
        *shipped.batteries.values(),
        *shipped.boards.values(),
    ]
    assert not [wrong for part in parts for wrong in part.contradictions()]
    assert all(part.source for part in parts)
