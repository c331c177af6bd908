//! Particles as PolyData.

use std::path::Path;

use super::appended::Appended;
use super::values::{DataArray, Values, check_arrays};
use super::{super::atomic::write_atomically, VtkError};

/// Writes particles to `path` (`.vtp`): `n` vertices at `positions`, each with an entry of every array.
///
/// `positions` are `n` 3-vectors of `f32` or `f64`, such as `&[[f64; 3]]`. Every array has `n` entries.
/// `time` is the simulated time. In ParaView, choose *Point Gaussian* or the glyph filter to see spheres.
///
/// # Errors
/// [`VtkError::Positions`], [`VtkError::ArrayLength`], [`VtkError::RepeatedArray`], [`VtkError::TooMany`],
/// [`VtkError::Geometry`] and [`VtkError::Write`], each with the path.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let temporary = tempfile::tempdir()?;
/// # let path = temporary.path().join("particles.vtp");
/// use xca_io::vtk::{DataArray, write_particles};
///
/// let positions = [[0.0, 0.0, 0.5], [1.0, 0.0, 0.5]];
/// let velocities = [[0.0, 0.0, -1.0]; 2];
/// let labels = [1_u32, 2];
/// let arrays = [DataArray::new("label", &labels[..]), DataArray::new("velocity (m/s)", &velocities[..])];
/// write_particles(&path, 0.25, positions[..].into(), &arrays)?;
/// # Ok(())
/// # }
/// ```
pub fn write_particles(
    path: &Path,
    time: f64,
    positions: Values<'_>,
    arrays: &[DataArray<'_>],
) -> Result<(), VtkError> {
    if positions.components() != 3 || !positions.is_float() {
        return Err(VtkError::Positions { path: path.to_owned() });
    }
    if !time.is_finite() {
        return Err(VtkError::Geometry { path: path.to_owned(), what: "the time", value: time });
    }
    let points = DataArray::new("Points", positions);
    check_arrays(path, &[points], positions.len())?;
    check_arrays(path, arrays, positions.len())?;
    let n = i32::try_from(positions.len())
        .map_err(|_| VtkError::TooMany { path: path.to_owned(), found: positions.len() })?;

    write_atomically(path, |file| {
        Appended::write(file, "PolyData", |appended| {
            format!(
                "<PolyData>\n{time}\
         <Piece NumberOfPoints=\"{n}\" NumberOfVerts=\"{n}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"0\">\n\
         <Points>\n{points}</Points>\n\
         <Verts>\n{connectivity}{offsets}</Verts>\n\
         {data}</Piece>\n</PolyData>\n",
                time = appended.field_data(time, arrays, ""),
                points = appended.array(&points),
                connectivity = appended.count("connectivity", 0..n),
                offsets = appended.count("offsets", (0..n).map(|point| point + 1)),
                data = appended.data("PointData", arrays),
            )
        })
    })?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;
    use std::io::Read;

    /// Parses a file with appended raw data by the specification. Returns the attributes and bytes of every
    /// `DataArray`, and where the last of them ends. Shares no code with the writer.
    fn parse(bytes: &[u8]) -> (Vec<(String, Vec<u8>)>, usize) {
        let marker = b"<AppendedData encoding=\"raw\">";
        let end_of_head = bytes.windows(marker.len()).position(|w| w == marker).unwrap();
        let head = std::str::from_utf8(&bytes[..end_of_head]).unwrap();
        let start = end_of_head + bytes[end_of_head..].iter().position(|&b| b == b'_').unwrap() + 1;
        let (mut arrays, mut end) = (Vec::new(), start);
        for element in head.split("<DataArray ").skip(1) {
            let attributes = element.split("/>").next().unwrap();
            let offset: usize =
                attributes.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
            let at = start + offset;
            let number = |i: usize| u64::from_le_bytes(bytes[at + 8 * i..][..8].try_into().unwrap()) as usize;
            let mut stream = at + 8 * (3 + number(0));
            let mut values = Vec::new();
            for block in 0..number(0) {
                let length = number(3 + block);
                let mut decoder = flate2::read::ZlibDecoder::new(&bytes[stream..stream + length]);
                decoder.read_to_end(&mut values).unwrap();
                stream += length;
            }
            arrays.push((attributes.to_owned(), values));
            end = stream;
        }
        (arrays, end)
    }

    fn f64s(bytes: &[u8]) -> Vec<f64> {
        bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
    }

    fn i32s(bytes: &[u8]) -> Vec<i32> {
        bytes.chunks_exact(4).map(|b| i32::from_le_bytes(b.try_into().unwrap())).collect()
    }

    #[test]
    fn every_array_is_found_where_its_offset_says() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.vtp");
        let positions = [[0.1, 0.2, 0.3], [1.0, -2.0, f64::NAN]];
        let arrays = [
            DataArray::new("label", &[3_u32, 4_000_000_000][..]),
            DataArray::new("velocity", &[[1.0_f32, 2.0, 3.0], [4.0, 5.0, 6.0]][..]),
            DataArray::new("a < \"b\"", &[7_u8, 8][..]),
            DataArray::new("charge", &[-1_i32, 1][..]),
        ];
        write_particles(&path, 0.125, positions[..].into(), &arrays).unwrap();
        let bytes = fs::read(&path).unwrap();
        assert!(bytes.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
        let (found, end) = parse(&bytes);
        assert_eq!(found.len(), 8);
        assert!(found[0].0.contains(r#"type="Float64" Name="TimeValue""#));
        assert_eq!(f64s(&found[0].1), [0.125]);
        assert!(found[1].0.contains(r#"type="Float64" Name="Points" NumberOfComponents="3""#));
        assert_eq!(f64s(&found[1].1)[..5], [0.1, 0.2, 0.3, 1.0, -2.0]);
        assert_eq!(i32s(&found[2].1), [0, 1]);
        assert_eq!(i32s(&found[3].1), [1, 2]);
        assert!(found[4].0.contains(r#"type="UInt32" Name="label" NumberOfComponents="1""#));
        assert_eq!(found[4].1, [[3, 0, 0, 0], 4_000_000_000_u32.to_le_bytes()].concat());
        assert!(found[5].0.contains(r#"type="Float32" Name="velocity" NumberOfComponents="3""#));
        assert_eq!(found[5].1[20..24], 6.0_f32.to_le_bytes());
        assert!(found[6].0.contains(r#"type="UInt8" Name="a &lt; &quot;b&quot;""#), "{}", found[6].0);
        assert_eq!(found[6].1, [7, 8]);
        assert_eq!(i32s(&found[7].1), [-1, 1]);
        // No byte is between the last block and the closing tag.
        assert_eq!(&bytes[end..], b"\n</AppendedData>\n</VTKFile>\n");
    }

    #[test]
    fn values_longer_than_a_chunk_are_complete() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.vtp");
        let positions: Vec<[f64; 3]> = (0..20_000).map(|i| [f64::from(i), 0.5, -1.0]).collect();
        write_particles(&path, 0.0, positions[..].into(), &[]).unwrap();
        let (found, _) = parse(&fs::read(&path).unwrap());
        assert_eq!(f64s(&found[1].1), positions.as_flattened());
        assert_eq!(i32s(&found[3].1).last(), Some(&20_000));
    }

    #[test]
    fn no_particles_is_a_file_too() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.vtp");
        let none: [[f32; 3]; 0] = [];
        write_particles(&path, 0.0, none[..].into(), &[DataArray::new("v", &[0_u8; 0][..])]).unwrap();
        let (found, _) = parse(&fs::read(&path).unwrap());
        assert_eq!(found.iter().map(|(_, block)| block.len()).collect::<Vec<_>>(), [8, 0, 0, 0, 0]);
    }

    #[test]
    fn wrong_shapes_are_named() {
        let path = Path::new("/nowhere/p.vtp");
        let write = |positions: Values<'_>, arrays: &[DataArray<'_>]| {
            write_particles(path, 0.0, positions, arrays).unwrap_err().to_string()
        };
        let three = [[0.0_f64; 3]; 3];
        let error = write(three[..].into(), &[DataArray::new("v", &[1.0_f64, 2.0][..])]);
        assert_eq!(error, "cannot write /nowhere/p.vtp: array `v` has 2 entries, not 3");
        let error = write(Values::interleaved(3, &[0.0_f64; 8][..]), &[]);
        assert_eq!(error, "cannot write /nowhere/p.vtp: array `Points` has 3 entries, not 3");
        let a = DataArray::new("v", &[1_u8; 3][..]);
        assert!(write(three[..].into(), &[a, a]).contains("two arrays are named `v`"));
        assert!(write([[0.0_f64; 2]; 3][..].into(), &[]).contains("3-vectors"));
        assert!(write([[0_i32; 3]; 3][..].into(), &[]).contains("3-vectors"));
        assert_eq!(write(three[..].into(), &[a]), "cannot write /nowhere/p.vtp");
        let error = write_particles(path, f64::NAN, three[..].into(), &[]).unwrap_err();
        assert!(error.to_string().contains("the time is NaN"), "{error}");
    }
}
