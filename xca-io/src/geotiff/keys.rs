//! The coordinate system of a GeoTIFF, kept as it stands in the file.

/// The keys of a GeoTIFF, which name its coordinate system: the tags `GeoKeyDirectory`, `GeoDoubleParams` and
/// `GeoAsciiParams` as they stand in the file, so that they are written again as they were.
#[derive(Debug, Clone, PartialEq)]
pub struct GeoKeys {
    pub(super) directory: Vec<u16>,
    pub(super) doubles: Vec<f64>,
    pub(super) text: String,
}

/// `GTModelTypeGeoKey`: whether coordinates are of a plane, or longitude and latitude.
const MODEL_TYPE: u16 = 1024;
const MODEL_IS_PROJECTED: u16 = 1;
const MODEL_IS_GEOGRAPHIC: u16 = 2;

/// `GTRasterTypeGeoKey`: whether pixels are areas or points.
const RASTER_TYPE: u16 = 1025;
const PIXEL_IS_AREA: u16 = 1;
const PIXEL_IS_POINT: u16 = 2;

/// `ProjectedCRSGeoKey` and `GeodeticCRSGeoKey`: codes of EPSG.
const PROJECTED: u16 = 3072;
const GEODETIC: u16 = 2048;

/// `GeogAngularUnitsGeoKey`, and the code of degrees.
const ANGULAR_UNIT: u16 = 2054;
const DEGREE: u16 = 9102;

/// What stands in place of a code for a system that the file defines itself.
const USER_DEFINED: u16 = 32_767;

/// The length of the header and of each key.
const KEY: usize = 4;

impl GeoKeys {
    /// The keys with these three tags; none if the directory is shorter than its header says.
    pub(super) fn new(directory: Vec<u16>, doubles: Vec<f64>, text: &str) -> Option<Self> {
        let count = usize::from(*directory.get(KEY - 1)?);
        // Keys count the bytes of the text, and a file may hold ASCII alone.
        let text = text.bytes().map(|byte| if byte.is_ascii() { char::from(byte) } else { '?' }).collect();
        (directory.len() >= KEY * (count + 1)).then_some(Self { directory, doubles, text })
    }

    /// The keys of a projected coordinate system, by its code in the register of EPSG: 32633 is UTM zone 33N.
    #[must_use]
    pub fn projected(code: u16) -> Self {
        Self::of_code(MODEL_IS_PROJECTED, PROJECTED, code)
    }

    /// The keys of a geographic coordinate system, longitude and latitude in degrees, by its code in the
    /// register of EPSG: 4326 is WGS 84.
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

    /// The code of the coordinate system in the register of EPSG, such as 32633 for UTM zone 33N; none of a
    /// system that the file defines itself.
    pub fn epsg(&self) -> Option<u16> {
        let codes = [PROJECTED, GEODETIC].into_iter().map(|key| self.short(key));
        // A projected system that the file defines has a code for its datum alone, which is another system.
        codes.flatten().next().filter(|code| ![0, USER_DEFINED].contains(code))
    }

    /// Whether coordinates are longitude and latitude in degrees.
    pub fn is_in_degrees(&self) -> bool {
        let is_geographic = match self.short(MODEL_TYPE) {
            Some(model) => model == MODEL_IS_GEOGRAPHIC,
            None => self.short(GEODETIC).is_some() && self.short(PROJECTED).is_none(),
        };
        is_geographic && self.short(ANGULAR_UNIT).is_none_or(|unit| unit == DEGREE)
    }

    /// Whether the keys name a coordinate system.
    pub(super) fn is_named(&self) -> bool {
        let keys = self.directory.chunks_exact(KEY).skip(1);
        keys.map(|key| key[0]).any(|key| key != RASTER_TYPE)
    }

    /// Whether the georeference is of the centres of pixels.
    pub(super) fn pixel_is_point(&self) -> bool {
        self.short(RASTER_TYPE) == Some(PIXEL_IS_POINT)
    }

    /// The value of a key that stands in the directory itself.
    fn short(&self, wanted: u16) -> Option<u16> {
        let count = usize::from(*self.directory.get(KEY - 1)?);
        let mut keys = self.directory.chunks_exact(KEY).skip(1).take(count);
        keys.find(|key| key[0] == wanted && key[1] == 0).map(|key| key[3])
    }
}
