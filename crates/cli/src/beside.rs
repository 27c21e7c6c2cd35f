//! Facts about a universal file of measured modes that the file does not contain.

use sweetspot::Result;
use sweetspot_study::files::measured::Beside;
use sweetspot_study::files::measured::places::{self, Places};
use sweetspot_study::measured::data::FrequencyUnit;
use uff58::Units;

use crate::value::{file_unit, named};

/// Facts that a universal file of modes does not contain.
#[derive(clap::Args, Clone)]
pub struct BesideArgs {
    /// Unit of length of a universal file that names no units (dataset 164), such as mm
    #[arg(long, value_name = "UNIT", requires = "measured", value_parser = file_unit,
          help_heading = "A universal file")]
    unit: Option<Units>,

    #[command(flatten)]
    places: PlacesArgs,

    /// Unit of the frequencies or poles of a universal file that breaks its format: Hz or rad/s [default: by the
    /// format, unless Modal A or the shapes contradict]
    #[arg(long, value_name = "UNIT", requires = "measured", help_heading = "A universal file",
          value_parser = named(FrequencyUnit::ALL, FrequencyUnit::name), hide_possible_values = true)]
    frequency_unit: Option<FrequencyUnit>,
}

impl BesideArgs {
    /// Reads the places if they are in a file.
    pub fn read(&self) -> Result<Beside> {
        let (unit, places) = (self.unit.clone(), self.places.read()?);
        Ok(Beside { unit, places, frequency_unit: self.frequency_unit })
    }
}

/// Positions of the nodes of a universal file.
#[derive(clap::Args, Clone)]
pub struct PlacesArgs {
    /// Positions of the nodes of a universal file without geometry, from the knob end: "1=0 in, 2=3 in", or a CSV file
    /// with the columns node,x_in
    #[arg(long, value_name = "PLACES", requires = "measured", help_heading = "A universal file")]
    places: Option<String>,
}

impl PlacesArgs {
    /// Reads the places if they are in a file.
    pub fn read(&self) -> Result<Option<Places>> {
        self.places.as_deref().map(places::read).transpose()
    }
}
