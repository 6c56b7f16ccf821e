"""`jumpcad calibrate`: calibrates springs, pins, release and drive on measured jumps."""

from pathlib import Path
from typing import Annotated

import typer

from jumpcad.cli.output import ForceFlag, JsonFlag, answer, print_text, status
from jumpcad.cli.searching import PlotsOption, require_pictures
from jumpcad.cli.subjects import File, SeedOption, option

SETTINGS = Path("my-settings.toml")
UNITS = {"distance": (1000.0, "mm"), "height": (1000.0, "mm"), "battery": (1.0, "J"), "speed": (1.0, "m/s"),
         "angle": (1.0, "°")}  # fmt: skip
SAMPLER = "walkers", "steps", "autocorrelation", "effective", "converged"
FILES_HELP = "Measured robots: templates (kenan-1.0, kenan-2.0) or TOML files, one each."
PREDICT_HELP = "Predict this measured robot, without calibrating on its jumps; may be repeated."


def calibrate(
    files: Annotated[list[str], typer.Argument(help=FILES_HELP, metavar="MEASUREMENTS...")],
    predict: Annotated[list[str] | None, typer.Option(help=PREDICT_HELP, metavar="MEASUREMENTS")] = None,
    output: Annotated[
        File, option("Write settings for simulate and optimize.", str(SETTINGS), "-o", "--output")
    ] = None,
    seed: SeedOption = 0,
    landing: Annotated[
        bool, option("Resting places from simulated landings (MuJoCo), not from a free travel.", None, "--landing")
    ] = False,
    hypotheses: Annotated[
        bool, option("Also the odds of other springs or a shared factor (a minute).", None, "--hypotheses")
    ] = False,
    plots: PlotsOption = None,
    force: ForceFlag = False,
    as_json: JsonFlag = False,
) -> None:
    """Calibrate springs, pins, release and drive on measured jumps, and show what the data do not determine."""
    from jumpcad.calibration import calibrate as run
    from jumpcad.calibration import elsewhere, load_subject, predicted_jump, settings_toml
    from jumpcad.calibration import plots as pictures
    from jumpcad.calibration.hypotheses import compare_hypotheses
    from jumpcad.calibration.subject import renamed, require_each_once, require_pairs
    from jumpcad.files.outputs import require_apart, require_target, write_atomically
    from jumpcad.search import save_figure

    require_apart({"--output": output, "--plots": plots}, {f"measurements {name}": name for name in files})
    if output:
        require_target(output, (".toml",), force)
    if plots:
        require_pictures(plots, pictures.PICTURES, force)
    require_each_once([*files, *(predict or ())])
    others = [load_subject(name) for name in predict or ()]
    with status("simulating the robots, sampling the posterior …"):
        posterior = run(files, seed, landing)
        others = [other.landing() if landing else other for other in others]
        known = posterior.model.subjects
        robots = renamed([*known, *others])  # no robot has the name of another
        require_pairs(robots)
        predictions = [predicted_jump(posterior, other, seed) for other in robots[len(known) :]]
        document = {
            "robots": [subject.name for subject in known],
            "parameters": posterior.summaries(),
            "energy_per_mass": posterior.energies(),
            "together": [list(pair) for pair in posterior.correlated()],
            "residuals": posterior.residuals(),
            "model_error": {
                one.name: {"median": one.surface.error, "largest": float(one.surface.errors.max())} for one in known
            },
            "sampler": {"seed": seed, **{name: getattr(posterior, name) for name in SAMPLER}},
            "predictions": {
                one.subject.name: {"jumps_share": one.jumps_share, **one.quantiles(), "beside": one.beside()}
                for one in predictions
            },
        }
        if hypotheses:
            document["hypotheses"] = compare_hypotheses(known, seed)
    if output:
        document |= {"settings": str(output), "elsewhere": list(elsewhere(posterior))}
        write_atomically(output, settings_toml(posterior), force)
    if plots:
        drawn = {name: getattr(pictures, name)(posterior) for name in pictures.PICTURES}
        document["pictures"] = [str(save_figure(figure, plots, name, force)) for name, figure in drawn.items()]
    answer(as_json, document, print_text, "calibrate", **document, units=UNITS)
