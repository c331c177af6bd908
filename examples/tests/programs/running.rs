//! Running a program in a folder of its own, and reading what it leaves.

use flate2::read::ZlibDecoder;
use serde_json::Value;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

pub(crate) const CADEM: &str = env!("CARGO_BIN_EXE_cadem");
pub(crate) const DEBRIS: &str = env!("CARGO_BIN_EXE_debris");
pub(crate) const HEAT: &str = env!("CARGO_BIN_EXE_heat");
pub(crate) const LANDSLIDE: &str = env!("CARGO_BIN_EXE_landslide");
pub(crate) const LIFE: &str = env!("CARGO_BIN_EXE_life");
pub(crate) const MOD2: &str = env!("CARGO_BIN_EXE_mod2");
pub(crate) const POND: &str = env!("CARGO_BIN_EXE_pond");

/// A folder that programs are run in.
pub(crate) struct Workplace {
    folder: TempDir,
}

/// Whether nothing but warnings is said.
pub(crate) fn warns_at_most(said: &str) -> bool {
    said.lines().all(|line| line.starts_with("warning: "))
}

impl Workplace {
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// The command `PROGRAM run OPTIONS`, the options being divided by blanks.
    pub(crate) fn command(&self, program: &str, options: &str) -> Command {
        self.invocation(program, &format!("run {options}"))
    }

    /// The command `PROGRAM WORDS`.
    pub(crate) fn invocation(&self, program: &str, words: &str) -> Command {
        let mut command = Command::new(program);
        command.args(words.split_whitespace()).current_dir(self.folder.path());
        command.env_remove("RUST_BACKTRACE");
        // The test is started by cargo, the program by the test.
        command.env_remove("CARGO");
        // Where there is no desktop, a layer that comes with Mesa complains of that on stderr.
        command.env("NODEVICE_SELECT", "1");
        command
    }

    pub(crate) fn run(&self, program: &str, options: &str) -> Output {
        self.command(program, options).output().unwrap()
    }

    /// Runs a program that must succeed; gives what it said.
    pub(crate) fn succeed(&self, program: &str, options: &str) -> String {
        let output = self.run(program, options);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{program} run {options}: {said}");
        // The line that shows how far a run has come is for terminals only; warnings are for all.
        assert!(warns_at_most(&said), "{program} run {options}: {said}");
        String::from_utf8(output.stdout).unwrap()
    }

    /// Runs a program that must fail with this exit code; gives what it said on stderr.
    pub(crate) fn fail(&self, code: i32, program: &str, options: &str) -> String {
        let output = self.run(program, options);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{program} run {options}: {said}");
        assert!(said.starts_with("error: "), "{program} run {options}: {said}");
        for word in ["panicked", "backtrace", "unwrap", "src/"] {
            assert!(!said.contains(word), "{program} run {options}: {said}");
        }
        said
    }
}

/// The files of a run that do not tell times, with their bytes.
pub(crate) fn results(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut results = Vec::new();
    for folder in [folder.to_owned(), folder.join("frames")] {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            if path.is_file() && name != "run.json" {
                results.push((name, fs::read(path).unwrap()));
            }
        }
    }
    results.sort();
    results
}

/// Demands that two runs left the same files with the same bytes.
pub(crate) fn assert_same_results(one: &Path, other: &Path, place: &str) {
    let (one, other) = (results(one), results(other));
    let names = |results: &[(String, Vec<u8>)]| -> Vec<String> {
        results.iter().map(|(name, _)| name.clone()).collect()
    };
    assert!(one.len() >= 5);
    assert_eq!(names(&one), names(&other), "{place}");
    for (one, other) in one.iter().zip(&other) {
        assert!(one.1 == other.1, "{place}: {} differs", one.0);
    }
}

/// The report of a run.
pub(crate) fn report(folder: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.join("run.json")).unwrap()).unwrap()
}

/// A table of numbers with a header.
pub(crate) struct Table {
    pub(crate) names: Vec<String>,
    pub(crate) rows: Vec<Vec<f64>>,
}

impl Table {
    pub(crate) fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        assert!(text.ends_with('\n'), "{} ends within a line", path.display());
        let mut lines = text.lines();
        let names: Vec<String> = lines.next().unwrap().split(',').map(str::to_owned).collect();
        let row = |line: &str| -> Vec<f64> { line.split(',').map(|field| field.parse().unwrap()).collect() };
        let rows: Vec<Vec<f64>> = lines.map(row).collect();
        assert!(rows.iter().all(|row| row.len() == names.len()));
        Self { names, rows }
    }

    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        let place = self.names.iter().position(|known| known == name).unwrap();
        self.rows.iter().map(|row| row[place]).collect()
    }

    pub(crate) fn last(&self, name: &str) -> f64 {
        *self.column(name).last().unwrap()
    }
}

/// The bytes of an array of a VTK file with appended raw data, compressed by zlib.
pub(crate) fn vtk_array(path: &Path, name: &str) -> Vec<u8> {
    let bytes = fs::read(path).unwrap();
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let start = bytes.windows(marker.len()).position(|window| window == marker).unwrap() + marker.len();
    let head = String::from_utf8_lossy(&bytes[..start]).into_owned();
    let element =
        head.split("<DataArray ").find(|element| element.contains(&format!("Name=\"{name}\""))).unwrap();
    let offset: usize =
        element.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    let at = start + offset;
    // How many blocks there are, two numbers more, the length of each block's stream, and the streams.
    let number = |i: usize| u64::from_le_bytes(bytes[at + 8 * i..][..8].try_into().unwrap()) as usize;
    let mut stream = at + 8 * (3 + number(0));
    let mut values = Vec::new();
    for block in 0..number(0) {
        let length = number(3 + block);
        ZlibDecoder::new(&bytes[stream..stream + length]).read_to_end(&mut values).unwrap();
        stream += length;
    }
    values
}

/// Checks that a run's folder holds everything that its report lists, whole.
pub(crate) fn check_files(folder: &Path) {
    let report = report(folder);
    let frames = report["progress"]["frames"].as_u64().unwrap() as usize;
    let mut found = 1;
    for name in report["files"].as_array().unwrap() {
        let name = name.as_str().unwrap();
        if let Some((before, after)) = name.split_once('*') {
            let start = folder.join(before);
            let stem = start.file_name().unwrap().to_str().unwrap();
            let entries = fs::read_dir(start.parent().unwrap()).unwrap().map(|entry| entry.unwrap().path());
            let of_series: Vec<PathBuf> = entries
                .filter(|path| path.file_name().unwrap().to_str().unwrap().starts_with(stem))
                .collect();
            assert_eq!(of_series.len(), frames, "{name}");
            for path in of_series {
                let bytes = fs::read(&path).unwrap();
                assert!(path.to_str().unwrap().ends_with(after));
                assert!(
                    bytes.starts_with(b"<?xml") && bytes.ends_with(b"</VTKFile>\n"),
                    "{}",
                    path.display()
                );
            }
            continue;
        }
        found += 1;
        let path = folder.join(name);
        match path.extension().unwrap().to_str().unwrap() {
            "png" => check_picture(&path),
            "csv" => assert!(!Table::read(&path).names.is_empty()),
            "pvd" => {
                let text = fs::read_to_string(&path).unwrap();
                let files: Vec<&str> =
                    text.split("file=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
                assert_eq!(files.len(), frames);
                assert!(files.iter().all(|file| folder.join(file).is_file()), "{text}");
            }
            other => panic!("a file of an unknown kind: {other}"),
        }
    }
    let series = Table::read(&folder.join("observables.csv"));
    assert_eq!(series.rows.len(), frames);
    assert_eq!(series.last("step"), report["progress"]["steps"].as_f64().unwrap());
    // Nothing else, and nothing half done.
    let entries = fs::read_dir(folder).unwrap().filter(|entry| entry.as_ref().unwrap().path().is_file());
    assert_eq!(entries.count(), found);
}

/// A picture, pixel by pixel.
pub(crate) struct Pixels {
    pub(crate) width: usize,
    pub(crate) colours: Vec<[u8; 3]>,
}

impl Pixels {
    pub(crate) fn read(path: &Path) -> Self {
        let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap()));
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut bytes).unwrap();
        Self { width: reader.info().width as usize, colours: bytes.as_chunks().0.to_vec() }
    }
}

/// Checks that a picture is whole and not of one colour.
fn check_picture(path: &Path) {
    let pixels = Pixels::read(path).colours;
    assert!(pixels.iter().any(|&value| value != pixels[0]), "{}", path.display());
}
