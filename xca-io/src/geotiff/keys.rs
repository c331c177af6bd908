//! The coordinate system of a GeoTIFF, kept unchanged.

use crate::map_unit::MapUnit;

/// The keys of a GeoTIFF, which name its coordinate system. They are the tags `GeoKeyDirectory`,
/// `GeoDoubleParams` and `GeoAsciiParams`, and are written exactly as they were read.
#[derive(Debug, Clone, PartialEq)]
pub struct GeoKeys {
    pub(super) directory: Vec<u16>,
    pub(super) doubles: Vec<f64>,
    pub(super) text: String,
}

/// `GTModelTypeGeoKey`: whether coordinates are planar, or longitude and latitude.
const MODEL_TYPE: u16 = 1024;
const MODEL_IS_PROJECTED: u16 = 1;
const MODEL_IS_GEOGRAPHIC: u16 = 2;

/// `GTRasterTypeGeoKey`: whether pixels are areas or points.
const RASTER_TYPE: u16 = 1025;
const PIXEL_IS_AREA: u16 = 1;
const PIXEL_IS_POINT: u16 = 2;

/// `ProjectedCRSGeoKey` and `GeodeticCRSGeoKey`: EPSG codes.
const PROJECTED: u16 = 3072;
const GEODETIC: u16 = 2048;

/// `GeogAngularUnitsGeoKey`, and the code for degrees.
const ANGULAR_UNIT: u16 = 2054;
const DEGREE: u16 = 9102;

/// `ProjLinearUnitsGeoKey`, and the codes of its units.
const LINEAR_UNIT: u16 = 3076;
const METRE: u16 = 9001;
const FOOT: u16 = 9002;
const SURVEY_FOOT: u16 = 9003;

/// `VerticalUnitsGeoKey`: the unit of heights.
const HEIGHT_UNIT: u16 = 4099;

/// The code of a system that the file defines itself.
const USER_DEFINED: u16 = 32_767;

/// The length of the header, and of each key.
const KEY: usize = 4;

impl GeoKeys {
    /// The keys with these three tags. `None` if the directory is shorter than its header says.
    pub(super) fn new(directory: Vec<u16>, doubles: Vec<f64>, text: &str) -> Option<Self> {
        let count = usize::from(*directory.get(KEY - 1)?);
        // Keys count the bytes of the text, and a file may hold only ASCII.
        let text = text.bytes().map(|byte| if byte.is_ascii() { char::from(byte) } else { '?' }).collect();
        (directory.len() >= KEY * (count + 1)).then_some(Self { directory, doubles, text })
    }

    /// The keys of a projected coordinate system by its EPSG code: 32633 is UTM zone 33N.
    #[must_use]
    pub fn projected(code: u16) -> Self {
        Self::of_code(MODEL_IS_PROJECTED, PROJECTED, code)
    }

    /// The keys of a geographic coordinate system by its EPSG code: 4326 is WGS 84. Coordinates are longitude
    /// and latitude in degrees.
    #[must_use]
    pub fn geographic(code: u16) -> Self {
        Self::of_code(MODEL_IS_GEOGRAPHIC, GEODETIC, code)
    }

    fn of_code(model: u16, key: u16, code: u16) -> Self {
        let header = [1, 1, 0, 3];
        let keys = [[MODEL_TYPE, 0, 1, model], [RASTER_TYPE, 0, 1, PIXEL_IS_AREA], [key, 0, 1, code]];
        Self {
            directory: [header].into_iter().chain(keys).flatten().collect(),
            doubles: Vec::new(),
            text: String::new(),
        }
    }

    /// The EPSG code of the coordinate system, such as 32633 for UTM zone 33N. `None` if the file defines the
    /// system itself.
    pub fn epsg(&self) -> Option<u16> {
        let codes = [PROJECTED, GEODETIC].into_iter().map(|key| self.short(key));
        // If the file defines a projected system, the geodetic code names only its datum.
        codes.flatten().next().filter(|code| ![0, USER_DEFINED].contains(code))
    }

    /// The unit of the coordinates. An EPSG code alone does not tell it, so a projected system without
    /// `ProjLinearUnits` counts as one in metres.
    pub fn unit(&self) -> MapUnit {
        let is_geographic = match self.short(MODEL_TYPE) {
            Some(model) => model == MODEL_IS_GEOGRAPHIC,
            None => self.short(GEODETIC).is_some() && self.short(PROJECTED).is_none(),
        };
        match self.short(ANGULAR_UNIT) {
            None | Some(DEGREE) if is_geographic => MapUnit::Degree,
            _ if is_geographic => MapUnit::Other,
            _ => length_unit(self.short(LINEAR_UNIT)),
        }
    }

    /// The unit of heights. Metres if the file does not say.
    pub(super) fn height_unit(&self) -> MapUnit {
        length_unit(self.short(HEIGHT_UNIT))
    }

    /// Whether the keys name a coordinate system.
    pub(super) fn is_named(&self) -> bool {
        let keys = self.directory.chunks_exact(KEY).skip(1);
        keys.map(|key| key[0]).any(|key| key != RASTER_TYPE)
    }

    /// Whether the georeference refers to the centres of pixels.
    pub(super) fn pixel_is_point(&self) -> bool {
        self.short(RASTER_TYPE) == Some(PIXEL_IS_POINT)
    }

    /// The value of a key that the directory itself holds.
    fn short(&self, wanted: u16) -> Option<u16> {
        let count = usize::from(*self.directory.get(KEY - 1)?);
        let mut keys = self.directory.chunks_exact(KEY).skip(1).take(count);
        keys.find(|key| key[0] == wanted && key[1] == 0).map(|key| key[3])
    }
}

/// The unit of lengths with this code.
fn length_unit(code: Option<u16>) -> MapUnit {
    match code {
        None | Some(METRE) => MapUnit::Metre,
        Some(FOOT) => MapUnit::Foot,
        Some(SURVEY_FOOT) => MapUnit::SurveyFoot,
        Some(_) => MapUnit::Other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit of a system with this model, EPSG key and further key.
    fn unit(model: u16, epsg: [u16; 2], further: Option<[u16; 2]>) -> MapUnit {
        let keys = [[MODEL_TYPE, model], epsg].into_iter().chain(further);
        let keys: Vec<[u16; KEY]> = keys.map(|[key, value]| [key, 0, 1, value]).collect();
        let header = [1, 1, 0, keys.len() as u16];
        let directory = std::iter::once(header).chain(keys).flatten().collect();
        GeoKeys::new(directory, Vec::new(), "").unwrap().unit()
    }

    #[test]
    fn the_unit_is_that_of_the_keys() {
        let (projected, geodetic) = ([PROJECTED, 32_633], [GEODETIC, 4326]);
        let linear = |code| unit(MODEL_IS_PROJECTED, projected, Some([LINEAR_UNIT, code]));
        assert_eq!(unit(MODEL_IS_PROJECTED, projected, None), MapUnit::Metre);
        assert_eq!([9001, 9002, 9003].map(linear), [MapUnit::Metre, MapUnit::Foot, MapUnit::SurveyFoot]);
        // A yard, and the unit of another kind of coordinates.
        assert_eq!(linear(9096), MapUnit::Other);
        assert_eq!(unit(MODEL_IS_GEOGRAPHIC, geodetic, Some([LINEAR_UNIT, FOOT])), MapUnit::Degree);
        assert_eq!(unit(MODEL_IS_PROJECTED, projected, Some([ANGULAR_UNIT, DEGREE])), MapUnit::Metre);
        // Radians.
        assert_eq!(unit(MODEL_IS_GEOGRAPHIC, geodetic, Some([ANGULAR_UNIT, 9101])), MapUnit::Other);
        assert_eq!(GeoKeys::geographic(4326).unit(), MapUnit::Degree);
        assert_eq!(GeoKeys::projected(32_633).unit(), MapUnit::Metre);
    }
}
