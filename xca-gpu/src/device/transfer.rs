//! Bytes between the host's memory and the device's.

use super::{Buffer, Device, DeviceError, Recorder};
use std::ops::Range;

/// The most bytes that are moved at once: enough to be fast, little enough to be beside the state.
const PIECE: u64 = 64 << 20;

impl Device {
    /// Writes bytes; the position and the number of bytes are multiples of four.
    pub(crate) fn upload(&self, buffer: &Buffer, start: u64, bytes: &[u8]) -> Result<(), DeviceError> {
        self.guarded("an upload", || {
            for (piece, position) in bytes.chunks(PIECE as usize).zip((start..).step_by(PIECE as usize)) {
                self.queue.write_buffer(&buffer.buffer, position, piece);
                if bytes.len() as u64 > PIECE {
                    // The pieces would else lie all in memory at once.
                    self.queue.submit([]);
                }
            }
        })
    }

    /// Reads bytes; the range begins and ends at multiples of four.
    pub(crate) fn download(&self, buffer: &Buffer, range: Range<u64>) -> Result<Vec<u8>, DeviceError> {
        let mut bytes = Vec::with_capacity((range.end - range.start) as usize);
        let mut start = range.start;
        while start < range.end {
            let size = PIECE.min(range.end - start);
            let landing = self.landing(size)?;
            let mut recorder = self.recorder();
            recorder.land(buffer, start, &landing);
            self.submit(recorder)?;
            bytes.extend(self.landed(&landing)?);
            start += size;
        }
        Ok(bytes)
    }

    /// Writes bytes to ranges, one after the other, as one piece of work; ranges begin and end at multiples
    /// of four.
    pub(crate) fn scatter(
        &self,
        buffer: &Buffer,
        ranges: &[Range<u64>],
        bytes: &[u8],
    ) -> Result<(), DeviceError> {
        self.guarded("an upload", || {
            let mut rest = bytes;
            for range in ranges {
                let (piece, after) = rest.split_at((range.end - range.start) as usize);
                self.queue.write_buffer(&buffer.buffer, range.start, piece);
                rest = after;
            }
        })
    }

    /// Reads ranges, one after the other, by one submission; ranges begin and end at multiples of four.
    pub(crate) fn collect(&self, buffer: &Buffer, ranges: &[Range<u64>]) -> Result<Vec<u8>, DeviceError> {
        let size = ranges.iter().map(|range| range.end - range.start).sum();
        if size == 0 {
            return Ok(Vec::new());
        }
        let landing = self.landing(size)?;
        let mut recorder = self.recorder();
        let mut place = 0;
        for range in ranges {
            let size = range.end - range.start;
            recorder.copy(buffer, range.start, &landing.buffer, place..place + size);
            place += size;
        }
        self.submit(recorder)?;
        self.landed(&landing)
    }

    /// Memory of the host that the device can write.
    pub(crate) fn landing(&self, size: u64) -> Result<Landing, DeviceError> {
        let description = wgpu::BufferDescriptor {
            label: Some("download"),
            size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        };
        let buffer = self
            .guarded(&format!("{size} bytes for a download"), || self.device.create_buffer(&description))?;
        Ok(Landing { buffer })
    }

    /// Waits for the device, and gives what has landed.
    pub(crate) fn landed(&self, landing: &Landing) -> Result<Vec<u8>, DeviceError> {
        self.landed_before(landing, landing.buffer.size())
    }

    /// Waits for the device, and gives so many of the bytes that have landed, a multiple of four.
    pub(crate) fn landed_before(&self, landing: &Landing, end: u64) -> Result<Vec<u8>, DeviceError> {
        let slice = landing.buffer.slice(..end);
        // The wait below tells whether it went wrong.
        self.guarded("a download", || slice.map_async(wgpu::MapMode::Read, |_| ()))?;
        self.wait()?;
        let refused = |error: wgpu::MapRangeError| DeviceError::Refused {
            what: "a download".to_owned(),
            reason: error.to_string(),
        };
        let bytes = slice.get_mapped_range().map_err(refused)?.to_vec();
        landing.buffer.unmap();
        Ok(bytes)
    }
}

/// Memory of the host where bytes of the device land.
pub(crate) struct Landing {
    buffer: wgpu::Buffer,
}

impl Recorder {
    /// Has bytes of a buffer land, as many as there is room for.
    pub(crate) fn land(&mut self, buffer: &Buffer, start: u64, landing: &Landing) {
        self.copy(buffer, start, &landing.buffer, 0..landing.buffer.size());
    }

    /// Has the first bytes of a buffer land at this place.
    pub(crate) fn land_at(&mut self, buffer: &Buffer, landing: &Landing, place: Range<u64>) {
        self.copy(buffer, 0, &landing.buffer, place);
    }
}
