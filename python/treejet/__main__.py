"""`treejet view|plot|movie|sweep|converge|export`: the program hands these words on to `python3 -m treejet`."""

from __future__ import annotations

import argparse
import os
import signal
import sys
from pathlib import Path


def arguments() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="treejet", description="Looks at runs, and makes many of them.")
    words = parser.add_subparsers(dest="word", required=True, metavar="view|plot|movie|sweep|converge|export")

    def about_run(word: str, what: str, out: str) -> argparse.ArgumentParser:
        command = words.add_parser(word, help=what, description=what)
        command.add_argument("run", metavar="DIR", type=Path, help="directory of the run")
        command.add_argument("--out", metavar="PATH", type=Path, help=out)
        return command

    view = about_run("view", "One HTML file to turn, zoom and play the jet in, without network", "the file (default: DIR/view.html)")
    view.add_argument("--frames", metavar="N", type=positive, default=600, help="frames at the most (default: 600)")
    plot = about_run("plot", "Pictures of the jet and of the observables", "where the pictures go (default: DIR)")
    plot.add_argument("--frame", metavar="N", type=int, help="frame, counted from 0 (default: the last)")
    movie = about_run("movie", "The frames as mp4 (with ffmpeg) or gif", "the file (default: DIR/movie.mp4, or .gif)")
    movie.add_argument("--frames", metavar="N", type=positive, default=240, help="frames at the most (default: 240)")
    export = about_run("export", "The trajectory as GSD (OVITO) or VTKHDF (ParaView 5.12 on)", "the file (default: DIR/traj.gsd, ...)")
    export.add_argument("--to", choices=("gsd", "vtkhdf"), required=True, help="format")
    export.add_argument("--force", action="store_true", help="replace a file that is there already")
    sweep = words.add_parser("sweep", help="Run a deck for many values of some directives", description=
                             "Runs a deck for many values of some directives, side by side; goes on where it was stopped.")
    sweep.add_argument("deck", metavar="DECK", type=Path)
    sweep.add_argument("--vary", action="append", default=[], metavar="VALUES",
                       help='"external potential: 6 kV .. 14 kV / 9", "viscosity: 1 .. 100 / 5 log" or "viscosity: 10, 20"; '
                            "several make a grid")
    sweep.add_argument("--list", metavar="CSV", type=Path, help="points from a table with a header of directives")
    sweep.add_argument("--jobs", metavar="J", type=positive, default=1, help="runs side by side (default: 1)")
    sweep.add_argument("--out", metavar="DIR", type=Path, default=Path("sweep"), help="directory (default: sweep)")
    sweep.add_argument("--only", metavar="N", type=positive, help="run point N alone, as a task of a job array; the table is "
                       "made by the same command without --only")
    budget = words.add_parser("converge", help="Tell how far the steady means of a deck are off", description=
                              "Runs a deck at finer time steps, Coulomb accuracy and elements, each alone and all together: an "
                              "error budget of its steady means. Goes on where it was stopped.")
    budget.add_argument("deck", metavar="DECK", type=Path)
    budget.add_argument("--quantities", metavar="KEYS", default="",
                        help="aperture, path, velocity, current, radius, beads or keys of tables, with commas (default: those of "
                        "the printstat list)")
    budget.add_argument("--accuracy", metavar="F", type=float, default=0.01, help="relative error that is wanted (default: 0.01)")
    budget.add_argument("--set", action="append", default=[], metavar="LINE", dest="lines", type=override,
                        help='a line that overrides the deck, as "flow rate: 60 mL/h"')
    budget.add_argument("--patience", metavar="X", type=float, default=200,
                        help="give a run up that takes X times as long as the deck's own (default: 200)")
    budget.add_argument("--jobs", metavar="J", type=positive, default=1, help="runs side by side, which blurs costs (default: 1)")
    budget.add_argument("--out", metavar="DIR", type=Path, default=Path("converge"), help="directory (default: converge)")
    return parser


def override(text: str) -> "tuple[str, str]":
    """Directive and value, with a colon between or as a deck has it.

    >>> override("flow rate: 60 mL/h"), override("model slender")
    (('flow rate', '60 mL/h'), ('model', 'slender'))
    """
    from .deck import directive

    name, colon, value = text.partition(":")
    found = (name.strip(), value.strip()) if colon else directive(text)
    if not found:
        raise argparse.ArgumentTypeError("expected a directive and its value")
    return found


def positive(text: str) -> int:
    if int(text) < 1:
        raise ValueError
    return int(text)


def main(words: "list[str]") -> int:
    options = arguments().parse_args(words)
    from .errors import TreejetError

    code = 0
    try:
        expect_one_process()
        code = {"view": look, "plot": look, "movie": look, "export": look, "sweep": sweep,
                "converge": converge}[options.word](options)
        sys.stdout.flush()
        return code
    except TreejetError as problem:
        print(f"treejet: {problem}", file=sys.stderr)
        return problem.exit_code
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for what is flushed as Python ends
        return code
    except OSError as problem:
        print(f"treejet: {problem.filename}: {problem.strerror}" if problem.filename else f"treejet: {problem}", file=sys.stderr)
        return 4
    except KeyboardInterrupt:
        print("treejet: stopped; the same command goes on", file=sys.stderr)
        return 75


def stop_in_time() -> None:
    """What a batch system or a closing terminal sends ahead of the end stops the runs as Ctrl-C does."""
    for ahead_of_the_end in (signal.SIGTERM, signal.SIGUSR1, signal.SIGHUP):
        signal.signal(ahead_of_the_end, signal.default_int_handler)


def expect_one_process() -> None:
    from .errors import InputError

    ranks = next((int(os.environ[name]) for name in ("OMPI_COMM_WORLD_SIZE", "PMI_SIZE") if name in os.environ), 1)
    if ranks > 1:
        raise InputError("this command makes processes of its own: start it without mpirun (sweep has --jobs)")


def look(options: argparse.Namespace) -> int:
    from .read import read

    run = read(options.run)
    if options.word == "view":
        from .view import view

        made = [view(run, options.out, options.frames)]
    elif options.word == "plot":
        from .plot import plot

        made = plot(run, options.out, options.frame)
    elif options.word == "movie":
        from .plot import movie

        made = [movie(run, options.out, options.frames)]
    else:
        from .export import export

        made = [export(run, options.to, options.out, options.force)]
    for path in made:
        print(f"wrote {path}")
    return 0


def sweep(options: argparse.Namespace) -> int:
    from . import sweep_plot
    from .errors import InputError
    from .sweep import from_csv, sweep, varied

    if bool(options.vary) == bool(options.list):
        raise InputError("a sweep needs --vary or --list, one of them")
    pairs = [varied(text) for text in options.vary]
    if len({name for name, _ in pairs}) < len(pairs):
        raise InputError("--vary: a directive is named twice")
    vary = from_csv(options.list) if options.list else dict(pairs)
    stop_in_time()
    points = sweep(options.deck, vary, options.out, options.jobs, lambda line: print(line, flush=True), options.only)
    if options.only is not None:
        return points[0].exit_code
    seeds = options.out / "seeds.csv"
    for path in (options.out / "sweep.csv", seeds if seeds.exists() else None, sweep_plot.draw(points, options.out / "sweep.png")):
        if path:
            print(f"wrote {path}")
    failed = [point for point in points if point.exit_code]
    if failed:
        print(f"treejet: {len(failed)} of {len(points)} points failed; see the last column of sweep.csv", file=sys.stderr)
    return max((point.exit_code for point in failed), default=0)


def converge(options: argparse.Namespace) -> int:
    from . import converge_write
    from .converge import converge

    stop_in_time()
    quantities = [word.strip() for word in options.quantities.split(",") if word.strip()]
    found = converge(options.deck, quantities, options.out, options.accuracy, options.jobs, lambda line: print(line, flush=True),
                     options.patience, **dict(options.lines))
    print(converge_write.text(found))
    for path in converge_write.write(found, options.out):
        print(f"wrote {path}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
