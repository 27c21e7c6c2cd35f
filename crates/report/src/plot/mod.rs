//! Results as pictures: SVG that reads on light and on dark paper, and PNG.
//!
//! A picture is a function of plain results, and [`picture::write`] makes files of pictures. Those of one command are
//! gathered in [`sets`]. Pictures for several subjects show the bats on top of each other, each with its colour, dash
//! and mark. A [`sheet`] defines the units and the width of a picture. All are drawn from the same parts, which can
//! also be used for others: a [`plane::Plane`] has two axes ([`axis`]) and takes [`mod@series`], [`place`] has the axes and
//! rows of positions, [`matrix`] draws a table as a map of colours. Positions can be read from the knob end at the
//! bottom and from the tip at the top.
//!
//! ```
//! use sweetspot_report::plot::sheet::Sheet;
//! use sweetspot_report::plot::{picture, sets};
//! use sweetspot::{Bat, Request, solve};
//!
//! # fn main() -> sweetspot::Result<()> {
//! let bat = Bat::builtin("r161")?;
//! let solution = solve(&bat, &Request::default())?;
//! let pictures = sets::of_modes(Sheet::of(&bat), &bat, &solution, None);
//! assert!(pictures[1].alt.contains("mode 1 at"));
//! # let folder = std::env::temp_dir().join(format!("sweetspot-plot-{}", std::process::id()));
//! picture::write(&folder, &pictures)?;
//! # std::fs::remove_dir_all(&folder).unwrap();
//! # Ok(())
//! # }
//! ```

pub mod theme;
pub mod words;
pub mod sheet;
pub mod route;
pub mod svg;
#[cfg(feature = "png")]
pub mod font;
#[cfg(feature = "png")]
pub mod png;
pub mod picture;
pub mod axis;
pub mod plane;
pub mod series;
pub mod place;
pub mod subject;
pub mod chart;
pub mod bars;
pub mod outline;
pub mod marks;
pub mod profile;
pub mod spot;
pub mod shapes;
pub mod exit_speed;
pub mod bbcor;
pub mod ledger;
pub mod contact;
pub mod hands;
pub mod response;
pub mod ringing;
pub mod front;
pub mod u_curve;
pub mod matrix;
pub mod lathe;
pub mod hoop;
pub mod wall_sweep;
pub mod sets;
pub mod compared;
pub mod change;
pub mod measured;
pub mod many;
pub mod calibrate;
pub mod tap;
pub mod identify;

pub use axis::Axis;
pub use bars::{Bar, BarRow};
pub use chart::{Chart, Panel};
pub use outline::{Lying, sections};
pub use picture::Picture;
pub use place::{PlaceRow, along};
pub use plane::{Frame, NUMBERS, Plane, head, ticks_up};
pub use route::Point;
pub use series::{Series, Tag, bats, digits, heights, legend_between, room, short, tags};
pub use sheet::{Paper, Sheet, Unit};
pub use svg::{MARKS, Mark, Pen, Svg};
pub use theme::{FRAME, GRID, Ink, MUTED, PAPER, SERIES, TEXT, TINT, series};
pub use words::{Anchor, LABEL, SMALL, TITLE, Type, fitted, width};
