//! Reading what was written, by the letter of the format, for the tests of this folder. Shares nothing with what writes.

use std::io::Read;

/// The head of a file with appended raw data, and the values of every array, with their attributes.
pub(super) fn parse(bytes: &[u8]) -> (String, Vec<(String, Vec<u8>)>) {
    let marker = b"<AppendedData encoding=\"raw\">";
    let end_of_head = bytes.windows(marker.len()).position(|window| window == marker).unwrap();
    let head = std::str::from_utf8(&bytes[..end_of_head]).unwrap();
    let start = end_of_head + bytes[end_of_head..].iter().position(|&byte| byte == b'_').unwrap() + 1;
    let mut arrays = Vec::new();
    for element in head.split("<DataArray ").skip(1) {
        let attributes = element.split("/>").next().unwrap();
        let offset: usize =
            attributes.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
        arrays.push((attributes.to_owned(), decompressed(&bytes[start + offset..])));
    }
    (head.to_owned(), arrays)
}

/// The values that start there, and were compressed by zlib.
pub(super) fn decompressed(bytes: &[u8]) -> Vec<u8> {
    let number =
        |place: usize| u64::from_le_bytes(bytes[8 * place..8 * place + 8].try_into().unwrap()) as usize;
    let [blocks, full, partial] = [0, 1, 2].map(number);
    let (mut values, mut at) = (Vec::new(), 8 * (3 + blocks));
    for block in 0..blocks {
        let end = at + number(3 + block);
        let before = values.len();
        flate2::read::ZlibDecoder::new(&bytes[at..end]).read_to_end(&mut values).unwrap();
        let wanted = if block + 1 == blocks && partial > 0 { partial } else { full };
        assert_eq!(values.len() - before, wanted);
        at = end;
    }
    values
}
