"""What a search found."""

from collections import Counter

import pytest

import jumpcad
from jumpcad.errors import CannotBuildError

QUICK = {"model": "capsule", "settings": "screening", "workers": 0}


def test_a_front_has_its_trials_and_its_own_objective():
    found = jumpcad.optimize("nsga2", evaluations=40, **QUICK)
    energies = [trial.design.spring_energy_j for trial in found.front]
    assert found.request.objective == "range"
    assert energies == sorted(energies)
    assert found.hypervolume > 0.0
    assert found.candidates == []


def test_where_nothing_jumps_the_trials_are_kept_and_the_design_is_asked_for_in_vain(tmp_path):
    found = jumpcad.optimize(
        "ga", evaluations=12, fixed={"stiffness_nmm_per_deg": 5, "compression_ratio": 0.1}, **QUICK
    )
    assert len(found.trials) == 12
    assert found.winner is None
    assert found.rejected == Counter(reason for trial in found.trials for reason in trial.evaluation.reasons)
    assert sum(found.rejected.values()) >= 12
    for ask in (lambda: found.design, lambda: found.score, lambda: found.save(tmp_path / "w.toml")):
        with pytest.raises(CannotBuildError, match=r"none of 12 designs jumps \(.*: widen the bounds"):
            ask()
    assert not (tmp_path / "w.toml").exists()
