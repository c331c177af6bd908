//! The cost of a list of frames in written bytes. The system counts the bytes of a whole process, so this
//! test has its own.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a test that panics has failed, as it should")]

use std::fs;
use xca_io::vtk::Collection;

/// The bytes that this process has written, as counted by the system.
fn written() -> u64 {
    let text = fs::read_to_string("/proc/self/io").unwrap();
    text.lines().find_map(|line| line.strip_prefix("wchar: ")).unwrap().parse().unwrap()
}

#[test]
fn a_collection_costs_as_many_bytes_as_it_has_frames() {
    const FRAMES: u32 = 2000;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.pvd");
    let mut collection = Collection::create(&path).unwrap();
    let before = written();
    for frame in 0..FRAMES {
        let file = folder.path().join(format!("frames/lava_{frame:08}.vti"));
        collection.add(f64::from(frame), &file).unwrap();
    }
    let bytes = written() - before;
    let length = fs::metadata(&path).unwrap().len();
    assert!(length > 60 * u64::from(FRAMES), "{length}");
    // Each frame writes its entry and the closing tags.
    assert!(bytes < length + 100 * u64::from(FRAMES), "{bytes} bytes written for a file of {length}");
}
