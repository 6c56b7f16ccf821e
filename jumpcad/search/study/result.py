"""`Result`: what a study found, as values, as plain data, and as a design file."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from jumpcad.design import Design
from jumpcad.dimensions import counted
from jumpcad.errors import CannotBuildError
from jumpcad.files.complaints import shown
from jumpcad.files.outputs import require_target, sealed, write_files
from jumpcad.search.fronts import front, hypervolume
from jumpcad.search.models import PrintedModel
from jumpcad.search.robust_pick import ActiveBound, Candidate
from jumpcad.search.study.request import Request
from jumpcad.search.study.trial import Trial, count_rejections, is_flat, to_frame
from jumpcad.search.study.why_none import why_required
from jumpcad.transforms import ByValue
from jumpcad.workshop import Workshop

HEADING = "# Found by jumpcad optimize"
WORKSHOP_END = "-workshop.toml"


def workshop_file(design_file: Path) -> Path:
    """Return where the workshop of a design file is written."""
    return design_file.with_name(f"{design_file.stem}{WORKSHOP_END}")


@dataclass(frozen=True, repr=False, eq=False)
class Result(ByValue):
    """What a study found: all trials of the search in order, and the `best`, None where no design jumps.

    `candidates` are the best designs, or those of the front, with the scores of their neighbours, most robust first;
    `bounds` those of the search on which the winner lies; `notes` what happened to the run: lost workers, quarantined
    designs. `evaluations` counts all robots that were built and simulated, those of the robust pick too. The search has
    `converged` if it ended before all of its evaluations, because its last steps gained too little. Where
    `rights_itself` is required, `righting` is simulated for the winner: `tries`, and the shares of as many `drops` and
    `landings` after which it stands.
    """

    request: Request
    trials: list[Trial]
    best: Trial | None
    candidates: list[Candidate]
    bounds: list[ActiveBound]
    notes: list[str]
    evaluations: int
    converged: bool = False
    righting: Mapping[str, float] = field(default_factory=dict)

    @property
    def winner(self) -> Trial | None:
        """The trial of the most robust of the best designs; None where there is none, for the reason `why_none`."""
        return None if self.why_none else self.candidates[0].trial if self.candidates else self.best

    @property
    def why_none(self) -> str:
        """Why there is no winner: no design jumps, or the scores tell none of those that do apart; mostly empty."""
        reasons = ", ".join(f"{name} {count}" for name, count in list(self.rejected.items())[:5])
        if self.best is None:
            none = f"none of {counted(len(self.trials), 'design')} jumps ({reasons})"
            return self.why_required or f"{none}: widen the bounds, or evaluate more designs"
        if is_flat(self.trials) and not self.request.is_front:
            alike = f"every design that jumps scores {self.best.score:g}: {self.request.aim.name} tells none apart"
            return f"{alike}; choose another objective{f'; rejected: {reasons}' if reasons else ''}"
        return ""

    @property
    def why_required(self) -> str:
        """What to relax where no design has a score, but some would without what is required; else empty."""
        return why_required(self.trials)

    @property
    def overlap(self) -> str:
        """What is said of counts of reasons where a design has several; else empty."""
        rejected = sum(one.score is None for one in self.trials)
        return f" (several for some of the {rejected})" if sum(self.rejected.values()) > rejected else ""

    @property
    def design(self) -> Design:
        """The winner's design."""
        return self._won().design

    @property
    def workshop(self) -> Workshop | None:
        """The workshop with the winner's values; None where the search varied none. Raises as `design`."""
        values, model = self._won().workshop, self.request.model
        return model.varied(values).workshop if values and isinstance(model, PrintedModel) else None

    @property
    def score(self) -> float:
        """The winner's score, by the study's objective. Raises as `design`."""
        return self._won().score or 0.0

    @property
    def fitness(self) -> float:
        """The winner's range over its longest link. Raises as `design`."""
        return self._won().evaluation.metrics["fitness"]

    @property
    def front(self) -> list[Trial]:
        """The trials that no other one beats at less cost (see `Request.against`), sorted by cost."""
        return front(self.trials, self.request.cost)

    @property
    def hypervolume(self) -> float:
        """The area that the front dominates (units of the score times those of the cost)."""
        return hypervolume(self.trials, cost=self.request.cost)

    @property
    def rejected(self) -> dict[str, int]:
        """How many designs each reason rejected, most frequent first."""
        return count_rejections(self.trials)

    def to_frame(self) -> Any:
        """Return the designs of the search as a `pandas.DataFrame`, a row each; `JumpcadError` without pandas."""
        return to_frame(self.trials)

    def to_toml(self) -> str:
        """Return the winner's design file. Raises as `design`."""
        heading = f"{HEADING}: {self.request.title} {self.score:.6g}.\n"
        if self._won().workshop:
            heading += f"# Its workshop was searched too: it is in the file that ends in {WORKSHOP_END}.\n"
        return sealed(heading + self.design.to_toml())

    def workshop_toml(self) -> str:
        """Return the winner's workshop file, complete; empty where the search varied none. Raises as `design`."""
        workshop = self.workshop
        if workshop is None:
            return ""
        changes = "".join(
            f"#   {key} = {shown(value) if isinstance(value, str) else f'{value:g}'}\n"
            for key, value in self._won().workshop.items()
        )
        return sealed(f"{HEADING}, with\n{changes}{workshop.to_toml()}")

    def save(self, path: str | Path, force: bool = False) -> Path:
        """Write the winner's design file and, where the search varied the workshop, beside it the workshop's.

        `jumpcad build X.toml --workshop X-workshop.toml` makes the robot.
        """
        texts = {Path(path): self.to_toml(), workshop_file(Path(path)): self.workshop_toml()}
        files = {file: text for file, text in texts.items() if text}
        for file in files:
            require_target(file, (".toml",), force)
        write_files(Path(path).parent, {file.name: text for file, text in files.items()}, force)
        return Path(path)

    def to_dict(self) -> dict[str, Any]:
        """Return plain data for JSON."""
        data: dict[str, Any] = {
            "method": self.request.method, "objective": self.request.aim.name, "evaluations": self.evaluations,
            "searched": len(self.trials), "converged": self.converged, "refused": self.rejected,
            "best": self.best and self.best.to_dict(), "winner": self.winner and self.winner.to_dict(),
            "candidates": [candidate.to_dict() for candidate in self.candidates],
            "active_bounds": [asdict(bound) for bound in self.bounds],
            "notes": [*self.notes, *filter(None, [self.why_none])],
        }  # fmt: skip
        if self.righting:
            data["righting"] = dict(self.righting)
        if self.request.is_front:
            data |= {"against": self.request.cost.name, "front": [trial.to_dict() for trial in self.front]}
            data["hypervolume"] = self.hypervolume
        return data

    def __repr__(self) -> str:
        found = "no winner" if self.winner is None else f"{self.request.aim.name} {self.score:.4g}"
        trials, candidates = counted(len(self.trials), "trial"), counted(len(self.candidates), "candidate")
        return f"<Result {self.request.method}: {found}, {trials}, {candidates}>"

    def _repr_html_(self) -> str:
        from jumpcad.notebook import figures_table

        return figures_table(self.request.title, self._lines())

    def _lines(self) -> Iterator[tuple[str, str]]:
        """Yield what a notebook shows: the winner, or the front, and what rejected designs."""
        yield "designs evaluated", f"{self.evaluations}, {len(self.trials)} of them by the search"
        if self.request.is_front:
            yield "hypervolume", f"{self.hypervolume:.4g}"
            for trial in self.front:
                cost = self.request.cost
                yield f"{cost.figure.meaning} {cost.shown(cost.of(trial)):.4g} {cost.figure.unit}", f"{trial.score:.6g}"
        elif self.winner is not None:
            yield self.request.aim.name, self.request.aim.shown(self.score)
        if self.candidates:
            yield "score that nine of ten neighbours reach", f"{self.candidates[0].robust_score:.6g}"
        if self.winner is not None:
            yield from ((name, f"{value:.5g}") for name, value in self.design.model_dump().items())
        yield from ((f"rejected: {reason}", str(count)) for reason, count in self.rejected.items())

    def _won(self) -> Trial:
        if self.winner is None:
            raise CannotBuildError(self.why_none)
        return self.winner
