//! Runs that are watched, in a terminal that is one for the program and that the test reads.
#![cfg(unix)]

use crate::running::{CADEM, HEAT, LIFE, Workplace};
use portable_pty::{Child, CommandBuilder, ExitStatus, MasterPty, PtySize, native_pty_system};
use std::io::{Read, Write};
use std::process::Command;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// How long a screen may take to become what it should be. It takes a moment; this only ends a test that
/// waits for what never comes.
const PATIENCE: Duration = Duration::from_secs(60);

/// A program in a terminal.
struct Terminal {
    master: Box<dyn MasterPty + Send>,
    keys: Box<dyn Write + Send>,
    child: Box<dyn Child + Send + Sync>,
    /// What the program writes; its end is that of the program.
    written: Receiver<Vec<u8>>,
    reader: Option<JoinHandle<()>>,
    screen: vt100::Parser,
    /// How the terminal was before the program began.
    before: String,
}

impl Terminal {
    /// Starts `PROGRAM watch OPTIONS`.
    fn watch(place: &Workplace, program: &str, options: &str) -> Self {
        let size = PtySize { rows: 30, cols: 100, pixel_width: 0, pixel_height: 0 };
        let pair = native_pty_system().openpty(size).unwrap();
        let before = settings(&*pair.master);
        let mut command = CommandBuilder::new(program);
        command.arg("watch");
        command.args(options.split_whitespace());
        command.cwd(place.path("."));
        command.env("TERM", "xterm-256color");
        command.env("COLORTERM", "truecolor");
        command.env_remove("NO_COLOR");
        command.env_remove("RUST_BACKTRACE");
        let child = pair.slave.spawn_command(command).unwrap();
        let mut reader = pair.master.try_clone_reader().unwrap();
        let (sender, written) = mpsc::channel();
        let reader = thread::spawn(move || {
            let mut bytes = [0; 4096];
            // At its end a terminal gives nothing, or an error.
            while let Ok(count @ 1..) = reader.read(&mut bytes) {
                if sender.send(bytes[..count].to_vec()).is_err() {
                    return;
                }
            }
        });
        let keys = pair.master.take_writer().unwrap();
        let screen = vt100::Parser::new(30.try_into().unwrap(), 100.try_into().unwrap(), 0);
        // What the program has of the terminal is its own now: so its end can be seen.
        drop(pair.slave);
        Self { master: pair.master, keys, child, written, reader: Some(reader), screen, before }
    }

    fn press(&mut self, keys: &str) {
        self.feed(keys.as_bytes());
    }

    fn feed(&mut self, bytes: &[u8]) {
        self.keys.write_all(bytes).unwrap();
        self.keys.flush().unwrap();
    }

    /// Closes the terminal, as whoever closes its window does, and waits for the end of the program.
    fn close(&mut self) -> ExitStatus {
        // The reader ends with the next picture.
        self.written = mpsc::channel().1;
        self.reader.take().unwrap().join().unwrap();
        self.keys = Box::new(std::io::sink());
        self.master = native_pty_system().openpty(PtySize::default()).unwrap().master;
        let begin = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status;
            }
            assert!(begin.elapsed() < PATIENCE, "the program goes on without its terminal");
            thread::sleep(Duration::from_millis(20));
        }
    }

    fn text(&self) -> String {
        self.screen.screen().contents()
    }

    /// Waits until the screen is as it should be.
    fn until(&mut self, what: &str, is_so: impl Fn(&str) -> bool) {
        let begin = Instant::now();
        while !is_so(&self.text()) {
            match self.written.recv_timeout(PATIENCE.saturating_sub(begin.elapsed())) {
                Ok(bytes) => self.screen.process(&bytes),
                Err(error) => panic!("{what}: {error}, and the screen is\n{}", self.text()),
            }
        }
    }

    /// The number of the step on the screen.
    fn step(&self) -> u64 {
        step(&self.text()).unwrap()
    }

    /// Waits until the program ends, having given the terminal back. What it says after that is on the
    /// screen.
    fn ended(&mut self) -> ExitStatus {
        let begin = Instant::now();
        loop {
            match self.written.recv_timeout(PATIENCE.saturating_sub(begin.elapsed())) {
                Ok(bytes) => self.screen.process(&bytes),
                Err(RecvTimeoutError::Disconnected) => break,
                Err(RecvTimeoutError::Timeout) => panic!("the program does not end\n{}", self.text()),
            }
        }
        let screen = self.screen.screen();
        assert!(!screen.alternate_screen() && !screen.hide_cursor(), "{}", self.text());
        assert_eq!(settings(&*self.master), self.before);
        self.child.wait().unwrap()
    }
}

impl Drop for Terminal {
    /// A test that has failed leaves no program behind.
    fn drop(&mut self) {
        let _ = self.child.kill();
    }
}

/// Echo, line by line or key by key, and so on.
fn settings(master: &dyn MasterPty) -> String {
    format!("{:?}", master.get_termios().unwrap())
}

fn step(text: &str) -> Option<u64> {
    text.strip_prefix("step ")?.split_whitespace().next()?.parse().ok()
}

/// Runs `PROGRAM watch OPTIONS` until it shows a step, and leaves it.
pub(crate) fn assert_watched(place: &Workplace, program: &str, options: &str) {
    let mut terminal = Terminal::watch(place, program, options);
    terminal.until("the run begins", |text| step(text).is_some());
    terminal.press("q");
    assert_eq!(terminal.ended().exit_code(), 0, "{program} watch {options}");
}

#[test]
fn a_run_is_paused_and_goes_on_step_by_step() {
    let place = Workplace::new();
    let mut terminal = Terminal::watch(&place, LIFE, "--engine reference");
    terminal.until("the run begins", |text| step(text).is_some_and(|step| step >= 2));
    assert!(terminal.screen.screen().alternate_screen() && terminal.screen.screen().hide_cursor());
    assert_ne!(settings(&*terminal.master), terminal.before);
    let text = terminal.text();
    assert!(text.contains("reference engine with 1 thread, f64") && text.contains("alive_sum"), "{text}");
    terminal.press(" ");
    terminal.until("it pauses", |text| text.contains("  paused  "));
    let before = terminal.step();
    terminal.press("nn");
    terminal.until("two steps are done", |text| step(text) >= Some(before + 2));
    // Were there more, they would come before what a later key does.
    terminal.press("z");
    terminal.until("it is closer", |text| text.contains("z whole"));
    assert_eq!(terminal.step(), before + 2);
    terminal.press(" ");
    terminal.until("it goes on", |text| step(text) > Some(before + 4) && !text.contains("paused"));
    terminal.press("q");
    assert_eq!(terminal.ended().exit_code(), 0);
    // It leaves nothing behind.
    assert_eq!((terminal.text().trim(), place.path("out").exists()), ("", false));
}

#[test]
fn the_picture_stays_at_the_end_until_it_is_left() {
    let place = Workplace::new();
    let mut terminal = Terminal::watch(&place, CADEM, "--steps 12 --every 5 --substate position");
    terminal.until("it ends", |text| text.starts_with("step 12 of 12  ended: all steps are done  time "));
    assert!(terminal.text().contains("2602 items, seen along y"), "{}", terminal.text());
    terminal.press("nr");
    terminal.until("it begins anew", |text| !text.contains("ended"));
    terminal.until("and ends again", |text| text.starts_with("step 12 of 12  ended"));
    terminal.press("\x1b");
    assert_eq!(terminal.ended().exit_code(), 0);
}

#[test]
fn ctrl_c_and_signals_give_the_terminal_back() {
    let place = Workplace::new();
    let mut terminal = Terminal::watch(&place, HEAT, "--size 8");
    terminal.until("the run begins", |text| step(text) > Some(0));
    terminal.press("\x03");
    assert_eq!(terminal.ended().exit_code(), 130);
    for signal in ["-TERM", "-HUP", "-INT"] {
        let mut terminal = Terminal::watch(&place, LIFE, "");
        terminal.until("the run begins", |text| step(text) > Some(0));
        let process = terminal.child.process_id().unwrap().to_string();
        assert!(Command::new("kill").args([signal, &process]).status().unwrap().success());
        assert_eq!(terminal.ended().exit_code(), 130, "{signal}");
    }
}

#[test]
fn the_end_of_the_terminal_is_that_of_the_program() {
    let place = Workplace::new();
    for time in 0..5 {
        let mut terminal = Terminal::watch(&place, LIFE, "--engine reference");
        terminal.until("the run begins", |text| step(text) > Some(0));
        let status = terminal.close();
        assert_eq!(status.exit_code(), 130, "{time}: {status:?}");
    }
}

#[test]
fn keys_are_found_again_behind_broken_ones() {
    let place = Workplace::new();
    // Half of a character, of a sequence, and of a bracketed paste.
    for broken in [&b"\xc3"[..], b"\xf0\x9f", b"\x1b[", b"\x1b[200~", b"\x1bO", b"\xff\x80"] {
        let mut terminal = Terminal::watch(&place, LIFE, "--engine reference");
        terminal.until("the run begins", |text| step(text) > Some(0));
        terminal.feed(broken);
        // The run goes on meanwhile: the first keys after it come later.
        let seen = terminal.step();
        terminal.until("it goes on", |text| step(text) > Some(seen + 20));
        terminal.press("q");
        assert_eq!(terminal.ended().exit_code(), 0, "{broken:?}");
    }
}

#[test]
fn a_screen_follows_the_size_of_the_terminal() {
    let place = Workplace::new();
    let mut terminal = Terminal::watch(&place, LIFE, "--seed 3");
    terminal.until("the run begins", |text| step(text) > Some(0) && text.contains("q quit"));
    terminal.press(" ");
    terminal.until("it pauses", |text| text.contains("paused"));
    for (rows, cols, wanted) in [(1, 1, "s"), (3, 10, "step"), (30, 100, "z closer")] {
        terminal.screen.screen_mut().set_size(rows.try_into().unwrap(), cols.try_into().unwrap());
        terminal.master.resize(PtySize { rows, cols, pixel_width: 0, pixel_height: 0 }).unwrap();
        terminal.until("it has the new size", |text| text.contains(wanted));
    }
    assert!(terminal.text().contains("alive_sum"), "{}", terminal.text());
    terminal.press("q");
    assert_eq!(terminal.ended().exit_code(), 0);
}

#[test]
fn a_fault_is_told_when_the_terminal_is_back() {
    let place = Workplace::new();
    place.write("fast.csv", "label,x,y,z,vx,vy,vz\n7,0.01,0.01,0.01,1e6,0,0\n");
    let mut terminal = Terminal::watch(&place, CADEM, "--particles fast.csv");
    let status = terminal.ended();
    let text = terminal.text();
    assert_eq!(status.exit_code(), 1, "{text}");
    assert!(text.starts_with("error: step 1: a particle moves further than its radius"), "{text}");
    assert!(!text.contains("q quit"), "{text}");
}

#[test]
fn without_a_terminal_nothing_is_watched() {
    let place = Workplace::new();
    let output = place.invocation(LIFE, "watch").output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.starts_with("error: `watch` needs a terminal; "), "{said}");
    assert!(said.contains("`run` writes files and `render` draws pictures"), "{said}");
    assert!(output.stdout.is_empty());
}

#[test]
fn what_cannot_be_watched_is_said_before_the_screen_is_taken() {
    let place = Workplace::new();
    for (program, options, wanted) in [
        (LIFE, "--substate colour", "unknown substate `colour`; there are alive"),
        (LIFE, "--layer 1", "there is no layer 1"),
        (CADEM, "--layer 1", "--axis and --layer are for slices of cells"),
        (LIFE, "--fps 0", "0 is not in 1..=60"),
        (
            LIFE,
            "--engine reference --threads 2",
            "--threads is for --engine cpu, not for the reference engine",
        ),
    ] {
        let mut terminal = Terminal::watch(&place, program, options);
        let status = terminal.ended();
        let text = terminal.text().replace('\n', "");
        assert_eq!(status.exit_code(), 2, "{text}");
        assert!(text.contains(wanted), "{options}: {text}");
    }
}
