//! Keys as they are pressed, changes of the size, and the end of the terminal.

use ratatui::crossterm::event::KeyEvent;

#[cfg(not(unix))]
pub(super) use of_others::Keyboard;
#[cfg(unix)]
pub(super) use of_unix::Keyboard;

/// What a terminal tells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Input {
    Key(KeyEvent),
    Resized,
    /// No key was pressed in time.
    Nothing,
    /// There is no terminal any more.
    Closed,
}

#[cfg(unix)]
mod of_unix {
    use super::super::keys::Decoder;
    use super::Input;
    use ratatui::crossterm::event::KeyEvent;
    use signal_hook::consts::SIGWINCH;
    use std::collections::VecDeque;
    use std::io::{self, Read};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
    use std::thread;
    use std::time::{Duration, Instant};

    /// The bytes of one key come within this time.
    const TOGETHER: Duration = Duration::from_millis(50);
    /// How many portions of bytes wait to be looked at; the terminal keeps more.
    const WAITING: usize = 16;

    /// The keyboard of the terminal on the standard input.
    ///
    /// A thread of its own reads it: whoever reads waits until there is a byte, and the end of the terminal
    /// is the end of what can be read.
    #[derive(Debug)]
    pub(crate) struct Keyboard {
        bytes: Receiver<Vec<u8>>,
        decoder: Decoder,
        /// When the last bytes came.
        last: Instant,
        keys: VecDeque<KeyEvent>,
        is_resized: Arc<AtomicBool>,
    }

    impl Keyboard {
        /// Begins to listen; to be done once, as nobody else can read then.
        pub(crate) fn listen() -> io::Result<Self> {
            let is_resized = Arc::new(AtomicBool::new(false));
            signal_hook::flag::register(SIGWINCH, Arc::clone(&is_resized))?;
            let (sender, bytes) = mpsc::sync_channel(WAITING);
            let reader = move || hand_on(io::stdin().lock(), &sender);
            thread::Builder::new().name("xca-keys".to_owned()).spawn(reader)?;
            let (decoder, keys) = (Decoder::default(), VecDeque::new());
            Ok(Self { bytes, decoder, last: Instant::now(), keys, is_resized })
        }

        /// What comes next, or nothing if nothing comes in this time.
        pub(crate) fn next(&mut self, patience: Duration) -> Input {
            loop {
                if let Some(key) = self.keys.pop_front() {
                    return Input::Key(key);
                }
                if self.is_resized.swap(false, Ordering::Relaxed) {
                    return Input::Resized;
                }
                match self.bytes.recv_timeout(patience) {
                    Ok(bytes) => {
                        self.keys.extend(bytes.iter().filter_map(|byte| self.decoder.take(*byte)));
                        self.last = Instant::now();
                    }
                    Err(RecvTimeoutError::Timeout) => {
                        let is_over = self.decoder.is_waiting() && self.last.elapsed() >= TOGETHER;
                        let key = if is_over { self.decoder.give_up() } else { None };
                        return key.map_or(Input::Nothing, Input::Key);
                    }
                    Err(RecvTimeoutError::Disconnected) => return Input::Closed,
                }
            }
        }
    }

    /// Hands bytes on until there are no more, or nobody wants them.
    fn hand_on(mut terminal: impl Read, sender: &SyncSender<Vec<u8>>) {
        let mut buffer = [0; 1024];
        loop {
            match terminal.read(&mut buffer) {
                Ok(0) => return,
                Ok(count) if sender.send(buffer[..count].to_vec()).is_err() => return,
                Ok(_) => {}
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(_) => return,
            }
        }
    }
}

#[cfg(not(unix))]
mod of_others {
    use super::Input;
    use ratatui::crossterm::event::{self, Event};
    use std::io;
    use std::time::Duration;

    /// The keyboard of the console.
    #[derive(Debug)]
    pub(crate) struct Keyboard;

    impl Keyboard {
        /// Begins to listen.
        pub(crate) fn listen() -> io::Result<Self> {
            Ok(Self)
        }

        /// What comes next, or nothing if nothing comes in this time.
        pub(crate) fn next(&mut self, patience: Duration) -> Input {
            match event::poll(patience) {
                Ok(true) => match event::read() {
                    Ok(Event::Key(key)) => Input::Key(key),
                    Ok(Event::Resize(..)) => Input::Resized,
                    Ok(_) => Input::Nothing,
                    Err(_) => Input::Closed,
                },
                Ok(false) => Input::Nothing,
                Err(_) => Input::Closed,
            }
        }
    }
}
