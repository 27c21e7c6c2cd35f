//! The part of the Python package that is written in Rust.
//!
//! Inputs and outputs are texts: bat files, scenes and the documents that the command line writes. The Python package
//! around it converts them to NumPy arrays.

use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::Builder;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use sweetspot::base::file;
use sweetspot::base::marks::written_out;
use sweetspot::base::threads;
use sweetspot::beam::assembly::Pencil;
use sweetspot::collision::Hitter;
use sweetspot::collision::figures::Figures;
use sweetspot::collision::sweep::{Trial, sweep};
use sweetspot::files::balls::ball;
use sweetspot::files::built_in as bats;
use sweetspot::files::scene_file;
use sweetspot::modes::prepared::{Prepared, prepare};
use sweetspot::modes::request::MOST_MODES;
use sweetspot::{Error, Request, Solution, Theory, solve};
use sweetspot_report::exchange::npz;
use sweetspot_report::many::folder::StudyFolder;
use sweetspot_report::many::part::{Division, made};
use sweetspot_report::many::source::Study as Source;
use sweetspot_report::many::sums;
use sweetspot_report::plot::picture::Picture;
use sweetspot_report::plot::sets::{Hits, of_modes};
use sweetspot_report::plot::sheet::Sheet;
use sweetspot_report::plot::tap;
use sweetspot_report::report::json::{self, ShapePoints};
use sweetspot_report::report::tap::{TapReport, unreadable};
use sweetspot_report::report::{hit_json, mistakes};
use sweetspot_report::schema;
use sweetspot_report::schema::hit::HitFile;
use sweetspot_study::tap::tapped::Tapped;
use sweetspot_tap::analysis::Analysis;
use sweetspot_tap::decode::{self, Part};
use sweetspot_tap::recording::Recording;

/// The package's exception for an error, with its `sweetspot-error/1` document.
fn raised(py: Python<'_>, error: &Error) -> PyErr {
    let document = schema::text(&mistakes::document(error));
    let made = py
        .import("sweetspot._errors")
        .and_then(|module| module.getattr("SweetspotError"))
        .and_then(|class| class.call1((error.to_string(), document)));
    made.map_or_else(|failed| failed, PyErr::from_value)
}

/// The result of `work`, run without the interpreter's lock, or the exception for its error.
fn free<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> sweetspot::Result<T> + Send,
) -> PyResult<T> {
    py.detach(work).map_err(|error| raised(py, &error))
}

/// The result of `work`. If Python raises an exception for a signal, this returns at once; `work` is told to stop and
/// ends in the background.
fn heard<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&AtomicBool) -> T + Send + 'static,
) -> PyResult<T> {
    const LISTENS: Duration = Duration::from_millis(50);
    let stop = Arc::new(AtomicBool::new(false));
    let work = Arc::new(Mutex::new(Some(work)));
    let (send, receive) = channel();
    let begun = Builder::new().spawn({
        let (stop, work) = (Arc::clone(&stop), Arc::clone(&work));
        move || {
            let work = work.lock().unwrap_or_else(PoisonError::into_inner).take();
            // After a signal there is no receiver.
            let _ = send.send(work.map(|work| work(&stop)));
        }
    });
    let Ok(thread) = begun else {
        // Without a thread an interrupt is not noticed.
        let work = work.lock().unwrap_or_else(PoisonError::into_inner).take();
        let found = work.map(|work| py.detach(|| work(&stop)));
        return found.ok_or_else(|| PyRuntimeError::new_err("nothing was made"));
    };
    let receive = Mutex::new(receive);
    let wait = || {
        let receive = receive.lock().unwrap_or_else(PoisonError::into_inner);
        receive.recv_timeout(LISTENS)
    };
    loop {
        match py.detach(wait) {
            Ok(Some(found)) => return Ok(found),
            Err(RecvTimeoutError::Timeout) => {
                py.check_signals().inspect_err(|_| stop.store(true, Ordering::Relaxed))?;
            }
            Ok(None) | Err(RecvTimeoutError::Disconnected) => match py.detach(|| thread.join()) {
                Err(mistake) => resume_unwind(mistake),
                Ok(()) => return Err(PyRuntimeError::new_err("nothing was made")),
            },
        }
    }
}

/// A bat.
#[pyclass(frozen, module = "sweetspot._core")]
struct Bat(sweetspot::Bat);

/// The request for modes.
struct Asked {
    modes: usize,
    tolerance: f64,
    theory: Option<Theory>,
}

impl Asked {
    fn new(modes: usize, tolerance: f64, name: Option<&str>) -> sweetspot::Result<Self> {
        if modes > MOST_MODES {
            return Err(Error::value("n", modes, format!("{MOST_MODES} modes at most")));
        }
        if !(tolerance > 0.0 && tolerance < 1.0) {
            return Err(Error::value("tol", tolerance, "a number between 0 and 1, such as 1e-6"));
        }
        let theory = name.map(|name| {
            let known = Theory::ALL.into_iter().find(|theory| theory.name() == name);
            let names = Theory::ALL.map(Theory::name).join(", ");
            known.ok_or_else(|| Error::value("theory", format!("\"{name}\""), names))
        });
        Ok(Self { modes, tolerance, theory: theory.transpose()? })
    }

    /// The bat with its moduli fitted to the tap, and its request.
    fn prepared(&self, bat: &sweetspot::Bat) -> sweetspot::Result<(sweetspot::Bat, Request)> {
        let theory = self.theory.unwrap_or_default();
        let (modes, tolerance) = (self.modes, self.tolerance);
        let request = Request { modes, tolerance, theory, ..Request::default() };
        let Prepared { bat, request, .. } = prepare(bat, &request)?;
        Ok((bat.into_owned(), request))
    }

    fn solved(&self, bat: &sweetspot::Bat) -> sweetspot::Result<(sweetspot::Bat, Solution)> {
        let (bat, request) = self.prepared(bat)?;
        let solution = solve(&bat, &request)?;
        Ok((bat, solution))
    }
}

/// The `sweetspot-tap/1` document of a recording of a bat's taps, and pictures.
fn tapped(
    bat: &sweetspot::Bat,
    recording: Recording,
) -> sweetspot::Result<(String, Vec<(String, String)>)> {
    let recordings = [recording];
    let analysis = Analysis::of(&recordings, None);
    let tapped = Tapped::heard(bat, &analysis, &[])?;
    let tapped = tapped.as_ref();
    let report = TapReport { bat, recordings: &recordings, analysis: &analysis, tapped };
    let pictures = tap::pictures(&report, Sheet::of(bat));
    Ok((schema::text(&report.document()), named(pictures)))
}

/// Pictures as their names and SVG texts.
fn named(pictures: Vec<Picture>) -> Vec<(String, String)> {
    pictures.into_iter().map(|picture| (picture.name, picture.svg)).collect()
}

#[pymethods]
impl Bat {
    #[new]
    fn new(py: Python<'_>, name: &str, text: &str, folder: PathBuf) -> PyResult<Self> {
        free(py, || sweetspot::Bat::from_text(name, text, &folder)).map(Self)
    }

    /// Name, length (m), mass (kg), balance point (m), inertia about a point (kg m²), warnings.
    fn summary(&self, pivot: f64) -> (String, f64, f64, f64, f64, Vec<String>) {
        let (bat, inertia) = (&self.0, self.0.inertia());
        let warnings = bat.warnings().iter().map(ToString::to_string).collect();
        let name = bat.name().to_owned();
        (name, bat.length(), inertia.mass, inertia.balance_point, inertia.about(pivot), warnings)
    }

    /// The `sweetspot-modes/1` document, and pictures.
    fn modes(
        &self,
        py: Python<'_>,
        n: usize,
        tol: f64,
        theory: Option<&str>,
        points: usize,
    ) -> PyResult<(String, Vec<(String, String)>)> {
        free(py, || {
            let (bat, solution) = Asked::new(n, tol, theory)?.solved(&self.0)?;
            let document = json::modes(&bat, &solution, ShapePoints::Even(points), true);
            let pictures = of_modes(Sheet::of(&bat), &bat, &solution, None);
            Ok((schema::text(&document), named(pictures)))
        })
    }

    /// The `sweetspot-hit/1` document, and pictures. `scene` is a JSON object, `ball` a built-in name or a
    /// file, `places` are in m.
    fn hit(
        &self,
        py: Python<'_>,
        scene: &str,
        ball_name: &str,
        places: Option<Vec<f64>>,
        tol: f64,
        theory: Option<&str>,
    ) -> PyResult<(String, Vec<(String, String)>)> {
        free(py, || {
            let asked = Asked::new(Request::default().modes, tol, theory)?;
            let setup = scene_file::from_text(scene, ball(ball_name, None)?)?;
            let model = setup.model()?;
            let (bat, request) = asked.prepared(&self.0)?;
            let (scene, law) = setup.scene(&bat, Some(tol))?;
            let length = bat.length();
            let places = places.unwrap_or_else(|| {
                (0..=100).map(|k| (0.5 + 0.005 * f64::from(k)).min(1.0) * length).collect()
            });
            if let Some(off) = places.iter().find(|x| !(0.0..=length).contains(*x)) {
                let expected = format!("places on the bat, 0 to {length} m");
                return Err(Error::value("at", format!("{off} m"), expected));
            }
            let trial = Trial { model, scene: &scene };
            let accuracy = trial.accuracy(&request, false);
            let hits = sweep(&bat, model, &scene, &accuracy, &places)?;
            let hitter = Hitter::new(model, &scene, &bat, &hits.solution, hits.effort)?;
            let figures = Figures::new(&bat, &hitter, law)?;
            let document = HitFile {
                figures: Some(hit_json::figures(&figures)),
                ..hit_json::hit(&bat, model, &scene, &hits.impacts, &figures.spot)
            };
            let seen = Hits { bat: &bat, model, scene: &scene, sweep: &hits, spot: &figures.spot };
            let pictures = seen.pictures(Sheet::of(&bat), None)?;
            Ok((schema::text(&document), named(pictures)))
        })
    }

    /// The analysis of a recording of this bat's taps.
    fn tap_file(&self, py: Python<'_>, path: PathBuf) -> PyResult<(String, Vec<(String, String)>)> {
        free(py, || {
            let shown = written_out(&path.display().to_string());
            let recording = decode::read(&path, Part::default());
            tapped(&self.0, recording.map_err(|error| unreadable(&shown, error))?)
        })
    }

    /// The analysis of samples, eight bytes each, the lowest first, at that rate.
    fn tap_samples(
        &self,
        py: Python<'_>,
        samples: &[u8],
        rate: f64,
    ) -> PyResult<(String, Vec<(String, String)>)> {
        let (samples, _) = samples.as_chunks::<8>();
        let samples = samples.iter().map(|one| f64::from_le_bytes(*one)).collect();
        free(py, || {
            let recording = Recording::of("samples", samples, rate);
            tapped(&self.0, recording.map_err(|error| unreadable("samples", error))?)
        })
    }

    /// K and M of the solved mesh as the bytes of a NumPy archive.
    fn matrices(
        &self,
        py: Python<'_>,
        n: usize,
        tol: f64,
        theory: Option<&str>,
    ) -> PyResult<Py<PyBytes>> {
        let bytes = free(py, || {
            let (bat, solution) = Asked::new(n, tol, theory)?.solved(&self.0)?;
            if !bat.fixtures().none_moving() {
                let found = "a bat with attachments, joints or supports";
                let expected = "a bare bat: K and M are those of its body";
                return Err(Error::value("matrices", found, expected));
            }
            let pencil = Pencil::of(&bat, &solution.mesh, solution.degree, solution.theory);
            let failed = |source| Error::Write { path: "bat.npz".into(), source };
            npz::matrices(&pencil, &solution).map_err(failed)
        })?;
        Ok(PyBytes::new(py, &bytes).unbind())
    }
}

/// The text of a built-in bat file.
#[pyfunction]
fn built_in(py: Python<'_>, name: &str) -> PyResult<Option<&'static str>> {
    let found = bats::named(Path::new(name)).map_err(|error| raised(py, &error))?;
    Ok(found.map(|(_, text)| text))
}

/// The names of the built-in bats.
#[pyfunction]
fn built_in_names() -> Vec<&'static str> {
    bats::bat_names()
}

/// A study: its rows are functions of their numbers.
#[pyclass(frozen, module = "sweetspot._core")]
struct Study(Arc<Source>);

#[pymethods]
impl Study {
    #[new]
    fn new(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        free(py, || Source::read(&path)).map(Arc::new).map(Self)
    }

    /// A study that a person has named, and the files outside its folder that it names, as shown in messages.
    #[staticmethod]
    fn named_by_a_person(py: Python<'_>, path: PathBuf) -> PyResult<(Self, Vec<String>)> {
        let (study, outside) = free(py, || Source::named_by_a_person(&path))?;
        let shown = outside.iter().map(|path| written_out(&path.display().to_string()));
        Ok((Self(Arc::new(study)), shown.collect()))
    }

    /// A study from its text, its files in a folder or below.
    #[staticmethod]
    fn of(py: Python<'_>, name: &str, text: &str, folder: PathBuf) -> PyResult<Self> {
        free(py, || Source::of(name, text, &folder)).map(Arc::new).map(Self)
    }

    /// Names and units of the columns.
    fn columns(&self) -> Vec<(String, String)> {
        self.0.rows.columns().into_iter().map(|[name, unit]| (name, unit)).collect()
    }

    /// The names of the columns that are numbers in every row.
    fn numbers(&self) -> Vec<String> {
        let columns = self.0.rows.columns();
        self.0.rows.numbers().into_iter().map(|k| columns[k][0].clone()).collect()
    }

    /// Warnings, one sentence each: about the bats, and about inputs without effect.
    fn warnings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        free(py, || Ok(self.0.rows.warnings()))
    }

    /// The study as one text that needs no file.
    fn alone(&self) -> String {
        self.0.alone()
    }

    /// A study that was sent here.
    #[staticmethod]
    fn arrived(py: Python<'_>, text: &str) -> PyResult<Self> {
        free(py, || Source::arrived(text)).map(Arc::new).map(Self)
    }

    /// Number of rows, and number of rows in a part.
    fn size(&self) -> (u64, u64) {
        let division = Division::of(&self.0.rows);
        (division.rows, division.rows_per_part)
    }

    /// Some parts of that number of rows, each as the bytes of a CSV file, on that number of threads (all without one).
    fn parts(
        &self,
        py: Python<'_>,
        parts: Vec<u64>,
        rows_per_part: u64,
        jobs: Option<usize>,
    ) -> PyResult<Vec<Py<PyBytes>>> {
        let division = self.division(rows_per_part);
        if let Some(other) = parts.iter().find(|k| **k >= division.parts()) {
            let last = division.parts() - 1;
            let expected = format!("a part of the study, 0 to {last}");
            return Err(raised(py, &Error::value("part", other, expected)));
        }
        let study = Arc::clone(&self.0);
        let texts = heard(py, move |stop| {
            let part = |k: usize| made(&study, division.part(parts[k]), stop, &|_| ());
            threads::with(jobs, || threads::map(parts.len(), part))
        })?;
        Ok(texts.iter().map(|text| PyBytes::new(py, text.as_bytes()).unbind()).collect())
    }

    /// Opens the folder of the study, or refuses the folder of another study. Returns the number of rows in a part
    /// there.
    fn open(&self, py: Python<'_>, out: PathBuf) -> PyResult<u64> {
        free(py, || StudyFolder::open(&out, &self.0).map(|folder| folder.division().rows_per_part))
    }

    /// Part k in an opened folder, if it exists and is correct.
    fn kept(
        &self,
        py: Python<'_>,
        out: PathBuf,
        rows_per_part: u64,
        k: u64,
    ) -> PyResult<Option<Py<PyBytes>>> {
        let division = self.division(rows_per_part);
        let part = free(py, || StudyFolder::again(&out, &self.0, division).kept(k))?;
        Ok(part.map(|part| PyBytes::new(py, &part).unbind()))
    }
}

impl Study {
    fn division(&self, rows_per_part: u64) -> Division {
        Division { rows: self.0.rows.count(), rows_per_part: rows_per_part.max(1) }
    }
}

/// Whether a file matches the sum beside it; false if there is none.
#[pyfunction]
fn fits_its_sum(py: Python<'_>, path: PathBuf) -> PyResult<bool> {
    free(py, || sums::fits(&path, &file::read_plain(&path)?))
}

/// Writes the sum of a file beside it.
#[pyfunction]
fn add_sum(py: Python<'_>, path: PathBuf) -> PyResult<()> {
    free(py, || sums::add(&path, &file::read_plain(&path)?))
}

/// Writes a file and then its sum.
#[pyfunction]
fn keep(py: Python<'_>, path: PathBuf, bytes: &[u8]) -> PyResult<()> {
    free(py, || sums::write(&path, bytes))
}

#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("MOST_JOBS", threads::MOST)?;
    module.add("MOST_BYTES", file::MOST)?;
    module.add_class::<Bat>()?;
    module.add_class::<Study>()?;
    module.add_function(wrap_pyfunction!(fits_its_sum, module)?)?;
    module.add_function(wrap_pyfunction!(add_sum, module)?)?;
    module.add_function(wrap_pyfunction!(keep, module)?)?;
    module.add_function(wrap_pyfunction!(built_in, module)?)?;
    module.add_function(wrap_pyfunction!(built_in_names, module)?)?;
    Ok(())
}
