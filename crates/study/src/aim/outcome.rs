//! The bat that meets a wish, or comes nearest to it.
//!
//! [`Outcome::of`] searches the least change, writes it with rounded stations and computes the goals of the written
//! bat. A least change lies on the edge of its tolerances, so rounding may move it out. The stations are then rounded
//! again with compensating targets; if that fails, the search is repeated with bands shifted by the same amount.

use crate::aim::aimed::{AimedTarget, Choice, Outcome, Output, largest};
use crate::aim::bench::{Bench, Terms};
use crate::aim::conflict::{Conflict, missed};
use crate::aim::limits::{KEPT, Limits, section};
use crate::aim::rounding::{Rounded, Rounding};
use crate::aim::rules::{Rule, RulesKept};
use crate::aim::search::{MISSED, Search, Searched, Weights};
use crate::aim::wish::{Band, Grid, Wish};
use crate::answers::Answer;
use crate::engine::{Bat, Error, Result, golden};

/// The answers that are reported before and after.
const TOLD: [Answer; 10] = [
    Answer::Mass,
    Answer::BalancePoint,
    Answer::Inertia,
    Answer::Frequency(1),
    Answer::Frequency(2),
    Answer::Frequency(3),
    Answer::Node(1),
    Answer::Node(2),
    Answer::ExitSpeed,
    Answer::ExitSpeedPlace,
];
/// Most repetitions of the search if rounding has moved the bat out of its bands.
const ANEW: usize = 4;
/// Factors by which the stations are rounded finer if no rounding as wished keeps the goals in their bands: two binding
/// goals may leave less room than a tenth of a millimetre needs.
const FINER: [f64; 4] = [1.0, 10.0, 100.0, 1000.0];

/// The least change of a bat, before it is written.
struct LeastChange {
    bench: Bench,
    found: Searched,
    /// Worst miss, in tolerances.
    miss: f64,
    norm: f64,
    wood: Option<String>,
}

impl Outcome {
    /// The least change of the bat that meets the wish, written with rounded stations.
    ///
    /// ```
    /// use sweetspot::bat::theory::Theory;
    /// use sweetspot::collision::{Model, Scene};
    /// use sweetspot_study::aim::bench::Terms;
    /// use sweetspot_study::aim::aimed::Outcome;
    /// use sweetspot_study::aim::wish::{Amount, Ask, Goal, Target, Wish};
    /// use sweetspot_study::lathe::workpiece::HitTerms;
    /// use sweetspot_study::answers::Answer;
    /// use sweetspot::{Bat, Request};
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
    /// #     "profile": { "unit": "in", "x": [0, 1.5, 3, 6, 12, 18, 24, 30, 33],
    /// #                  "diameter": [1.8, 1.0, 0.95, 0.95, 1.1, 1.5, 2.2, 2.5, 2.5] } }"#;
    /// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
    /// let request = Request { theory: Theory::Timoshenko, ..Request::default() };
    /// let hit = HitTerms { scene: Scene::default(), model: Model::Contact, exactly: false };
    /// let terms = Terms { request, hit, law: None };
    /// // 3 % less swing weight, and the first frequency within half a hertz of what it was.
    /// let lighter = Ask::Change(Amount::Share(-0.03), Some(Amount::Share(0.001)));
    /// let same = Ask::Change(Amount::Si(0.0), Some(Amount::Si(0.5)));
    /// let targets = vec![
    ///     Target { goal: Goal::Answer(Answer::Inertia), ask: lighter },
    ///     Target { goal: Goal::Answer(Answer::Frequency(1)), ask: same },
    /// ];
    /// let wish = Wish { targets, remove_only: true, ..Wish::default() };
    /// let outcome = Outcome::of(&bat, &wish, &terms)?;
    /// assert!(outcome.met && outcome.conflict.is_none());
    /// assert!(outcome.bat.inertia().about(0.1524) < 0.972 * bat.inertia().about(0.1524));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Value`] about a wish that contradicts itself or the bat; those of [`sweetspot::solve()`] and of a
    /// hit.
    pub fn of(bat: &Bat, wish: &Wish, terms: &Terms) -> Result<Self> {
        if wish.goals().is_empty() {
            let expected = "one target at least, such as \"swing weight -3 %\"";
            return Err(Error::value("targets", "no target", expected));
        }
        let wish = &wish.of_bat(bat);
        let bench = Bench::new(bat, wish, terms.clone())?;
        let start = bench.look(&vec![0.0; bench.unknowns()])?.values;
        if let Some(k) = start.iter().position(|value| !value.is_finite()) {
            let found = format!("{}, which this bat has not", bench.goals[k].name());
            return Err(Error::value(format!("targets[{k}].name"), found, "what this bat has"));
        }
        let bands = wish.bands(&start, bat)?;
        let mut least = least(bench, wish, &bands, None)?;
        for wood in &wish.free.woods {
            let other = bat.with(|parts| parts.material = wood.clone())?;
            let bench = Bench::new(&other, wish, terms.clone())?;
            let tried = self::least(bench, wish, &bands, wood.name.clone())?;
            let better =
                (tried.miss.max(MISSED), tried.norm) < (least.miss.max(MISSED), least.norm);
            if better {
                least = tried;
            }
        }
        Writing { wish, bands, bat, grid: wish.grid(bat) }.outcome(least)
    }

    /// Replaces the bat by the one read from the written file, and computes its goals anew.
    ///
    /// # Errors
    ///
    /// Those of [`Bench::of`].
    pub fn read_back(mut self, written: Bat, wish: &Wish, terms: &Terms) -> Result<Self> {
        let bench = Bench::new(&self.start, wish, terms.clone())?;
        for (target, value) in self.targets.iter_mut().zip(bench.of(&written)?) {
            *target = AimedTarget::new(target.band, value, target.price);
        }
        self.bat = written;
        self.outputs = told(&bench, &self.start, &self.bat)?;
        self.rules = rules(wish, &self.bat, &bench)?;
        self.judge();
        Ok(self)
    }
}

/// The least change on that bench.
fn least(bench: Bench, wish: &Wish, bands: &[Band], wood: Option<String>) -> Result<LeastChange> {
    let limits = Limits::new(wish, &bench.bat);
    let search = Search::new(&bench, &limits);
    let start = vec![0.0; bench.unknowns()];
    let found = search.from(&start, bands, &Weights::met(bands.len()))?;
    let norm = search.norm(&found.p);
    let misses = bands.iter().zip(&found.values).map(|(band, value)| band.miss(*value));
    let miss = misses.fold(0.0, f64::max);
    drop(search);
    Ok(LeastChange { bench: bench.clone(), found, miss, norm, wood })
}

/// The data for writing a change.
struct Writing<'a> {
    wish: &'a Wish,
    bands: Vec<Band>,
    bat: &'a Bat,
    grid: Grid,
}

impl Writing<'_> {
    fn outcome(self, least: LeastChange) -> Result<Outcome> {
        let LeastChange { bench, found, wood, .. } = least;
        let all = vec![true; self.bands.len()];
        let limits = Limits::new(self.wish, &bench.bat);
        let search = Search::new(&bench, &limits);
        let (found, conflict) = match missed(&found, &self.bands, &all) {
            true => self.nearest(&bench, &search, found)?,
            false => (found, None),
        };
        let norm = search.norm(&found.p);
        let prices = self.prices(&found, norm);
        let (rounded, tried) = self.finest(&bench, &found, conflict.is_some())?;
        let bats = tried + found.bats + conflict.as_ref().map_or(0, |conflict| conflict.bats);
        let Rounded { draft, grid, values, p, norm: written, steeper, stopped, .. } = rounded;
        let chosen = bench.extras.iter().enumerate().map(|(k, extra)| Choice {
            what: extra.what,
            start: extra.start,
            found: bench.extra(&p, k),
        });
        let stretch = bench.stretch(&p);
        let free = bench.splines.stretches.iter().map(|s| s.map(|end| end * stretch));
        let kept_within_m =
            moved_beside(&free.collect::<Vec<_>>(), &bench.rechosen(&bench.bat, &p)?, &draft.bat);
        let broken = draft.broken.iter().map(|broken| broken.by.abs()).fold(0.0, f64::max);
        let bat = draft.bat.with(|parts| self.name(parts))?;
        let [largest_cut_m, largest_added_m] = largest(&draft.stations);
        let kept = |by: f64| if by <= KEPT { 0.0 } else { by };
        let targets = self.bands.into_iter().zip(values).zip(prices);
        let mut outcome = Outcome {
            met: false,
            targets: targets.map(|((band, of), price)| AimedTarget::new(band, of, price)).collect(),
            conflict,
            rules: rules(self.wish, &bat, &bench)?,
            norm_mm: written,
            largest_cut_m,
            largest_added_m,
            limits_broken_m: kept(broken),
            kept_within_m,
            steeper_by: self.wish.slope.map(|_| kept(steeper)),
            iterations: found.iterations,
            bats_solved: bats,
            stopped,
            free: chosen.collect(),
            wood,
            outputs: told(&bench, self.bat, &bat)?,
            change: draft.stations,
            start: self.bat.clone(),
            rigid_wall: bench.rigid_wall(&bat),
            bat,
            grid,
            finer: self.grid.round / grid.round,
            slope: self.wish.slope,
            remove_only: self.wish.remove_only,
        };
        outcome.judge();
        Ok(outcome)
    }

    /// The rounding of a least change that leaves the goals in their bands, no finer than needed, or the best of all,
    /// and the bats that were computed.
    fn finest(&self, bench: &Bench, first: &Searched, once: bool) -> Result<(Rounded, usize)> {
        let (mut best, mut bats) = (None::<Rounded>, 0);
        for finer in FINER {
            if best.as_ref().is_some_and(|best| best.worst <= 1e-9 || once) {
                break;
            }
            let (rounded, tried) = self.rounded((bench, first, once), finer)?;
            bats += tried;
            best = Some(rounded.better(best));
        }
        Ok((best.expect("one draft at least was made"), bats))
    }

    /// The best rounding of a least change, this many times finer than wished, and the number of bats computed. If a
    /// rounding moves a goal out, the search is repeated with narrower bands.
    fn rounded(
        &self,
        (bench, first, once): (&Bench, &Searched, bool),
        finer: f64,
    ) -> Result<(Rounded, usize)> {
        /// The distance inside its band at which a goal is sought again, in tolerances.
        const INSIDE: f64 = 0.25;
        let limits = &Limits::new(self.wish, &bench.bat);
        let (wanted, grid) = (&self.bands, Grid { round: self.grid.round / finer, ..self.grid });
        let rounding = Rounding { bench, limits, bands: wanted, grid, finer };
        let (mut bands, mut gentler) = (wanted.clone(), limits.clone());
        let (mut found, mut bats, mut best) = (first.clone(), 0, None::<Rounded>);
        for again in 1..=ANEW {
            let search = Search::new(bench, &gentler);
            let (rounded, off) = rounding.of(&found, search.norm(&found.p))?;
            bats += rounded.drafts;
            gentler.gentler_by(1.2 * rounded.steeper);
            let better = rounded.better(best);
            let enough = again == ANEW || once || better.worst <= 1e-9;
            best = Some(better);
            if enough {
                break;
            }
            // Repeats the search for goals that rounding then moves to their targets.
            for ((band, of), off) in bands.iter_mut().zip(wanted).zip(&off) {
                let by = off * of.scale;
                // Finer digits need only a part of the shift, then more of it.
                let share = again as f64 / ANEW as f64;
                let room = match finer > 1.0 {
                    true => (share * share * off.abs()).min(INSIDE / finer),
                    false => INSIDE,
                };
                let inside = (room * of.scale).min(INSIDE * (of.high - of.low));
                band.low = of.low - by + inside;
                band.high = of.high - by - inside;
            }
            let search = Search::new(bench, &gentler);
            found = search.from(&found.p, &bands, &Weights::met(bands.len()))?;
            bats += found.bats;
        }
        Ok((best.expect("one draft at least was made"), bats))
    }

    /// The nearest bat to bands that a search has missed, and their conflict; `None` if the bat found on the way meets
    /// all of them.
    fn nearest(
        &self,
        bench: &Bench,
        search: &Search,
        found: Searched,
    ) -> Result<(Searched, Option<Conflict>)> {
        let bands = &self.bands;
        let (conflict, mut known) = Conflict::of(search, bands, &found)?;
        let before = found.bats;
        if conflict.members.len() < bands.len() {
            let start = vec![0.0; bench.unknowns()];
            let weighted = search.from(&start, bands, &conflict.nearest(bands.len()))?;
            known.insert(0, Searched { bats: before + weighted.bats, ..weighted });
        }
        known.insert(0, found);
        let nearest = |a: &Searched, b: &Searched| total(bands, a).total_cmp(&total(bands, b));
        let bats = known.iter().map(|found| found.bats).max().unwrap_or(0);
        let best = known.into_iter().min_by(nearest).expect("one was found");
        let all = vec![true; bands.len()];
        if missed(&best, bands, &all) {
            return Ok((Searched { bats, ..best }, Some(conflict)));
        }
        let least = search.from(&best.p, bands, &Weights::met(bands.len()))?;
        let bats = bats + conflict.bats + least.bats;
        Ok((Searched { bats, ..least }, None))
    }

    fn name(&self, parts: &mut sweetspot::bat::body::Parts) {
        parts.name = format!("{}, aimed", self.bat.name());
    }

    /// The decrease of the norm per SI unit of each goal. It exists only for a least change: not for a bat that misses
    /// a target, that is hardly changed, or for which the search stopped short.
    fn prices(&self, found: &Searched, norm: f64) -> Vec<Option<f64>> {
        /// A smaller change (mm) does not count.
        const NONE: f64 = 1e-3;
        let all = vec![true; self.bands.len()];
        let least = !missed(found, &self.bands, &all) && found.stopped.is_none() && norm > NONE;
        let of = |(k, band): (usize, &Band)| {
            let price = found.prices[k].abs() / (2.0 * norm) / band.scale;
            least.then_some(if found.prices[k].abs() > 1e-6 { price } else { 0.0 })
        };
        self.bands.iter().enumerate().map(of).collect()
    }
}

/// The sum of all misses of a bat, in tolerances: of two bats the one with the smaller sum is nearer.
fn total(bands: &[Band], found: &Searched) -> f64 {
    bands.iter().zip(&found.values).map(|(band, value)| band.miss(*value)).sum()
}

/// The largest difference of two bats' diameters outside the stretches that may change (m). Between any two stations of
/// either, both curves are cubics; the maximum is located between the closest places of a fine scan.
fn moved_beside(free: &[[f64; 2]], old: &Bat, new: &Bat) -> f64 {
    const PLACES: usize = 16;
    let length = old.length();
    let mut borders =
        [old.profile().borders(), new.profile().borders(), vec![0.0, length]].concat();
    borders.extend(free.iter().flatten());
    borders.retain(|x| (0.0..=length).contains(x));
    borders.sort_by(f64::total_cmp);
    let kept = |x: f64| !free.iter().any(|s| x > s[0] && x < s[1]);
    let mut most: f64 = 0.0;
    for ends in borders.windows(2).filter(|ends| ends[1] > ends[0]) {
        let (from, to) = (ends[0], ends[1]);
        let inside = 0.5 * (from + to);
        if !kept(inside) {
            continue;
        }
        let by = |x: f64| {
            let [a, b] = [old, new].map(|bat| section(bat.profile(), x, inside).outer);
            2.0 * (a - b).abs()
        };
        let place = |k: usize| from + (to - from) * k as f64 / PLACES as f64;
        let nearest = (0..=PLACES).max_by(|a, b| by(place(*a)).total_cmp(&by(place(*b))));
        let k = nearest.unwrap_or_default();
        let around = [place(k.saturating_sub(1)), place((k + 1).min(PLACES))];
        let top = golden::least(around[0], around[1], |x| -by(x));
        most = most.max(by(top)).max(by(place(k)));
    }
    most
}

/// The main answers of both bats, with equal swings.
fn told(bench: &Bench, start: &Bat, bat: &Bat) -> Result<Vec<Output>> {
    let of = |bat: &Bat| -> Result<Vec<Option<f64>>> {
        let piece = bench.piece_of(bat, &TOLD)?;
        Ok(piece.values().iter().map(|figure| figure.map(|figure| figure.value)).collect())
    };
    let (before, after) = (of(start)?, of(bat)?);
    let both = TOLD.into_iter().zip(before.into_iter().zip(after));
    Ok(both.map(|(answer, (start, found))| Output { answer, start, found }).collect())
}

/// The rules, with the bat's value for each.
fn rules(wish: &Wish, bat: &Bat, bench: &Bench) -> Result<Option<RulesKept>> {
    let Some(set) = &wish.rules else { return Ok(None) };
    let bbcor = match set.rules.iter().any(|(rule, _)| *rule == Rule::BbcorAtMost) {
        true => bench.piece_of(bat, &[Answer::Bbcor])?.values()[0].map(|figure| figure.value),
        false => None,
    };
    Ok(Some(set.judged(bat, bbcor)))
}
