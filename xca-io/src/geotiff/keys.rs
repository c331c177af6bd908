//! The coordinate system of a GeoTIFF, kept unchanged.

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
