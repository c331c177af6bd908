//! What carries bytes between the processes of a job.

/// Carries pieces of messages between the processes of a job, which are numbered from 0: their ranks.
///
/// Pieces from one process to another arrive in the order in which they were sent.
pub trait Wire: Send {
    /// The rank of this process.
    fn rank(&self) -> usize;

    /// The number of processes.
    fn size(&self) -> usize;

    /// The number of processes on this machine, this one included.
    fn on_this_machine(&self) -> usize;

    /// The number of this process among those on this machine, from 0.
    fn number_on_this_machine(&self) -> usize;

    /// The name of this machine.
    fn machine(&self) -> String;

    /// Begins to send a piece. Other calls go on with it.
    fn send(&mut self, to: usize, tag: i32, bytes: Vec<u8>);

    /// Goes on sending. Whether a piece still waits for its receiver.
    fn is_sending(&mut self) -> bool;

    /// A piece that has arrived; nothing where there is none now.
    fn poll(&mut self) -> Option<Piece>;

    /// Waits until all processes do the same, and hands on what arrives meanwhile.
    fn finish(&mut self, arrived: &mut dyn FnMut(Piece));

    /// Ends all processes of the job at once.
    fn abort(&self, code: i32);
}

/// A piece of a message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Piece {
    /// The rank of the sender.
    pub from: usize,
    /// What it is about.
    pub tag: i32,
    /// The bytes.
    pub bytes: Vec<u8>,
}
