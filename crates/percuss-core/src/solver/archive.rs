//! Archive of the state of a run: one list of items that writes a checkpoint and reads it.

use serde::{Serialize, de::DeserializeOwned};

use crate::Error;

/// Bytes of a checkpoint on their way out or in.
pub struct Archive<'a>(Direction<'a>);

enum Direction<'a> {
    Write(Vec<u8>),
    Read(&'a [u8]),
}

impl<'a> Archive<'a> {
    /// An empty archive, to be written.
    pub(super) fn writer() -> Self {
        Self(Direction::Write(Vec::new()))
    }

    /// The archive of these bytes, to be read.
    pub(super) fn reader(bytes: &'a [u8]) -> Self {
        Self(Direction::Read(bytes))
    }

    /// Writes an item, or replaces it by the one in the archive.
    ///
    /// # Errors
    /// [`Error::Checkpoint`] when the archive ends early or holds something else.
    pub fn item<T: Serialize + DeserializeOwned>(&mut self, item: &mut T) -> Result<(), Error> {
        match &mut self.0 {
            Direction::Write(bytes) => {
                let written = postcard::to_extend(item, std::mem::take(bytes));
                *bytes = written.map_err(|error| Error::Checkpoint {
                    reason: format!("the state cannot be encoded: {error}"),
                    remedy: "run without checkpoints".to_owned(),
                })?;
            }
            Direction::Read(bytes) => {
                let (read, rest) =
                    postcard::take_from_bytes(bytes).map_err(|_| super::checkpoint::damaged())?;
                *item = read;
                *bytes = rest;
            }
        }
        Ok(())
    }

    /// Whether the archive replaces the items.
    pub fn is_read(&self) -> bool {
        matches!(self.0, Direction::Read(_))
    }

    /// The bytes written.
    pub(super) fn into_bytes(self) -> Vec<u8> {
        match self.0 {
            Direction::Write(bytes) => bytes,
            Direction::Read(bytes) => bytes.to_vec(),
        }
    }
}
