"""Spoils the proof in one place after the other and says which test finds it.

    python3 search/proof_mutations.py [NAME ...]

Works on a copy of the project in a temporary folder; each place takes a build of the library. A mutation that no
test finds, or that its own test does not find, is told, and the exit code is 1.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent.parent
INTERVAL = "src/base/interval/"
PROOF = "crates/proof/src/enclosure/"

# Name, file, what stands there, what is put there, the test that finds it.
MUTATIONS = [
    ("down rounds up", INTERVAL + "mod.rs",
     "let below = x - (PHI * x.abs() + LEAST);", "let below = x + (PHI * x.abs() + LEAST);",
     "every_operation_of_intervals_holds_the_exact_result"),
    ("a product rounds its upper end down", INTERVAL + "mod.rs",
     "false => Self { low: down(a * b), high: up(a * b) },",
     "false => Self { low: down(a * b), high: down(a * b) },",
     "every_operation_of_intervals_holds_the_exact_result"),
    ("a number of a table is off by two units in the last place", "crates/proof/src/gauss_24.txt",
     None, None,
     "every_number_of_the_tables_is_the_nearest_double"),
    ("too few points for a degree", "crates/proof/src/series.rs",
     "assert!(self.degree < 2 * N,", "assert!(self.degree < 2 * N + 2,",
     "points_do_not_integrate_what_is_beyond_them"),
    ("values without their rounding", "crates/proof/src/series.rs",
     "Values { at, radius: bound(self.radius + rounding), degree: self.degree() }",
     "Values { at, radius: bound(self.radius + 0.0 * rounding), degree: self.degree() }",
     "every_operation_of_series_holds_the_exact_polynomial"),
    ("a product of values without the other's radius", "crates/proof/src/series.rs",
     "let off = own * other.radius + (its + other.radius) * self.radius + UNIT * own * its;",
     "let off = own * other.radius + UNIT * own * its;",
     "radii_go_through_every_operation"),
    ("1/EI without its share", PROOF + "sections.rs",
     "(share < most).then_some(Nearly { series, share })",
     "(share < most).then_some(Nearly { series, share: 1e-16 })",
     "what_is_taken_for_the_softness_is_nowhere_below_it"),
    ("EI at most in place of at least", PROOF + "sections.rs",
     "both.fold(f64::INFINITY, |least, (b, a)| least.min(of(b, a).low))",
     "both.fold(0.0_f64, |least, (b, a)| least.max(of(b, a).low))",
     "sections_are_what_the_bat_says_they_are_worth_and_never_less_than_their_least"),
    ("a cell left out of the norm", PROOF + "norms.rs",
     "for k in 0..=stretches.len() {", "for k in 1..=stretches.len() {",
     "norms_of_the_uniform_bat_are_those_in_closed_form"),
    ("strains on different sides left out of the norm", PROOF + "norms.rs",
     "let norm = square + square + across + across;",
     "let norm = square + square + across;",
     "norms_of_the_uniform_bat_are_those_in_closed_form"),
    ("no other eigenvalue counted", PROOF + "conclude.rs",
     "let count = known.iter().take_while(|c| **c > others).count();",
     "let count = known.len();",
     "conclusions_hold_the_eigenvalues_of_matrices_whose_trials_are_known"),
    ("the first that is not proven taken to be small", PROOF + "conclude.rs",
     "let next = ends.get(count).map_or(others, |[_, d]| others.max(*d));",
     "let next = 0.0 * others;",
     "conclusions_hold_the_eigenvalues_of_matrices_whose_trials_are_known"),
    ("half of the residual", PROOF + "energies.rs",
     "let residual = up(left / strain.low);", "let residual = 0.25 * up(left / strain.low);",
     "tens_of_thousands_of_lies_prove_nothing_false"),
    ("a residual of the knob side alone", PROOF + "energies.rs",
     "for k in (self.root..count).rev() {", "for k in (self.root + 1..count).rev() {",
     "tens_of_thousands_of_lies_prove_nothing_false"),
    ("a spring left out of the residual", PROOF + "energies.rs",
     "sum = up(sum + up(off.square().high / stiffness.low));",
     "sum = up(sum + up(0.0 * off.square().high / stiffness.low));",
     "tens_of_thousands_of_lies_prove_nothing_false"),
    ("what gives way left out of the residual", PROOF + "energies.rs",
     "up(off.square().high / stiffness.low)\n", "up(0.0 * off.square().high / stiffness.low)\n",
     "tens_of_thousands_of_lies_prove_nothing_false"),
    ("a joint that does not turn the bat on its tip side", PROOF + "moved.rs",
     "let theta = theta + kink;", "let theta = theta + ZERO * kink;",
     "tens_of_thousands_of_lies_prove_nothing_false"),
    ("a joint that does not turn the bat on its knob side", PROOF + "moved.rs",
     "([w, theta], [w, theta - kink])", "([w, theta], [w, theta])",
     "tens_of_thousands_of_lies_prove_nothing_false"),
    ("what gives way without its own part of the norm", PROOF + "norms.rs",
     "[trace, soft * before + point(0.5) * trace.square(), ZERO]", "[trace, soft * before, ZERO]",
     "norms_of_uniform_bats_that_give_way_are_those_in_closed_form"),
    ("a mass on a spring that does not move alone", PROOF + "norms.rs",
     "if give.way == YieldingPart::Hung { met.mass } else { ZERO }", "ZERO",
     "norms_of_uniform_bats_that_give_way_are_those_in_closed_form"),
    ("a joint that a held bat does not have", PROOF + "holding.rs",
     "sum = sum + a.gives[give.number] * b.gives[give.number] * softness(&give);",
     "sum = sum + ZERO * a.gives[give.number] * b.gives[give.number] * softness(&give);",
     "norms_of_uniform_bats_that_give_way_are_those_in_closed_form"),
    ("a wall's data taken to be exact", PROOF + "sections.rs",
     "turned, sure.area] {", "turned] {",
     "the_shear_stiffness_of_a_tube_is_within_its_share"),
    ("a support that does not hold", PROOF + "moved.rs",
     "self.contacts[k].stiffness.map_or(0.0, |_| trial.held[k])", "trial.held[k]",
     "tens_of_thousands_of_lies_prove_nothing_false"),
    ("a curvature that does not lead to the next border", PROOF + "moved.rs",
     "(all[0], all[1]) = (turns, Interval::point(3.0) * slopes * over);",
     "(all[0], all[1]) = (turns, Interval::point(2.0) * slopes * over);",
     "tens_of_thousands_of_lies_prove_nothing_false"),
    ("reactions out of balance", PROOF + "reactions.rs",
     "let moment = moment - force * arm(first);", "let moment = moment;",
     "tens_of_thousands_of_lies_prove_nothing_false"),
    ("too much taken off the norm", PROOF + "holding.rs",
     "Some([trace, first + first - second])", "Some([trace, first + first])",
     "norms_of_the_held_uniform_bat_are_those_in_closed_form"),
    ("a spring taken to be a support", PROOF + "holding.rs",
     "if let Some(stiffness) = self.stiffness(&holds[i]) {",
     "if let Some(stiffness) = self.stiffness(&holds[i]).filter(|_| false) {",
     "norms_of_the_held_uniform_bat_are_those_in_closed_form"),
    ("a bed that holds more than it does", PROOF + "holding.rs",
     "Some(bed.stiffness * self.length(bed) * share)",
     "Some(bed.stiffness * self.length(bed) + ZERO * share)",
     "norms_on_a_bed_are_above_those_in_closed_form_and_near_them"),
    ("the bed's line left out of the residual", PROOF + "energies.rs",
     "up(beyond / bed.stiffness.low)", "up(0.0 * beyond / bed.stiffness.low)",
     "tens_of_thousands_of_lies_prove_nothing_false"),
    ("printed decimals rounded to nearest", "crates/report/src/report/proven.rs",
     "let step = 0.6 * 10f64.powf(-places);", "let step = 0.0 * 10f64.powf(-places);",
     "decimals_are_never_inside_of_the_ends"),
]


def spoil(text, old, new):
    """The text with one thing changed; of a table, a weight two units in the last place up."""
    if old is not None:
        assert text.count(old) == 1, f"{text.count(old)} times: {old}"
        return text.replace(old, new)
    import math
    rows = text.splitlines(keepends=True)
    weights = next(k for k, row in enumerate(rows) if not row.startswith("#")) + 1
    number, rest = rows[weights].split(" ", 1)
    off = math.nextafter(math.nextafter(float(number), 2.0), 2.0)
    rows[weights] = f"{off!r} {rest}"
    return "".join(rows)


def main():
    wanted = sys.argv[1:]
    missed = 0
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / "project"
        shutil.copytree(HERE, copy, ignore=shutil.ignore_patterns("target", ".git"))
        for name, file, old, new, test in MUTATIONS:
            if wanted and not any(part in name for part in wanted):
                continue
            path = copy / file
            text = path.read_text()
            path.write_text(spoil(text, old, new))
            target = ["-p", "sweetspot-report", "--lib"] if file.startswith("crates/report") else ["--test", "guarantee"]
            run = ["cargo", "test", "--offline", *target, test]
            found = subprocess.run(run, cwd=copy, capture_output=True, text=True)
            path.write_text(text)
            ran = f"{test} ... FAILED" in found.stdout or "test result: FAILED" in found.stdout
            print(f"{'found' if ran else 'NOT FOUND':<10} {name}: {test}", flush=True)
            missed += not ran
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
