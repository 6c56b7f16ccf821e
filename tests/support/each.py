"""One test for one rule that holds for many inputs."""

import inspect
from collections.abc import Callable, Iterable
from functools import wraps
from typing import Any


def each(names: str | tuple[str, ...], cases: Iterable[Any]) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Let a test try all cases, one after the other; the first that fails is named.

    Written like `pytest.mark.parametrize`, which makes a test of each. The cases share the test's fixtures; a `sandbox`
    is furnished anew for each of them.
    """
    several = tuple(names.replace(",", " ").split()) if isinstance(names, str) else names
    tried = list(cases)
    assert tried, "no cases"

    def loop(test: Callable[..., None]) -> Callable[..., None]:
        @wraps(test)
        def try_all(**fixtures: Any) -> None:
            for case in tried:
                values = dict(zip(several, [case] if len(several) == 1 else case, strict=True))
                if "sandbox" in fixtures:
                    fixtures["sandbox"].furnish()
                try:
                    test(**fixtures, **values)
                except BaseException as error:
                    error.add_note(f"with {', '.join(f'{name} = {value!a:.300}' for name, value in values.items())}")
                    raise

        signature = inspect.signature(test)
        others = [one for name, one in signature.parameters.items() if name not in several]
        vars(try_all)["__signature__"] = signature.replace(parameters=others)
        return try_all

    return loop
