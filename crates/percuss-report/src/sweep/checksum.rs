//! Checksum and identity of the files of a sweep's folder, which reveal damaged and foreign files.
//!
//! Those of a block are in the key-value metadata of the Parquet file, which readers ignore.

use flate2::Crc;

use super::manifest::Manifest;

/// Key of the checksum in the file's metadata.
const CHECKSUM: &str = "percuss.checksum";
/// Key of the name of the block.
pub(super) const BLOCK: &str = "percuss.block";
/// Prefix of the checksum, and its placeholder during the computation.
const MARK: &[u8] = b"crc32:";
const OPEN: &[u8] = b"00000000";

/// The notes that a block's file gets; the checksum is open until [`close`].
pub(super) fn notes(manifest: &Manifest, block: u64) -> [(&'static str, String); 2] {
    [(BLOCK, block_name(manifest, block)), (CHECKSUM, open())]
}

/// The open checksum of a file that is not complete yet.
pub(super) fn open() -> String {
    String::from_utf8_lossy(&[MARK, OPEN].concat()).into_owned()
}

/// A text with its open checksum computed.
pub(super) fn closed(text: String) -> String {
    let mut bytes = text.into_bytes();
    close(&mut bytes);
    // Digits take the place of digits.
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Writes the checksum of all the file (CRC-32, with its own digits as zeros) into it.
pub(super) fn close(file: &mut [u8]) {
    if let Some(place) = place(file) {
        let digits = checksum(file, place);
        file[place..place + OPEN.len()].copy_from_slice(digits.as_bytes());
    }
}

/// Whether the checksum of a file is correct.
pub(super) fn is_whole(file: &[u8]) -> bool {
    place(file)
        .is_some_and(|place| file[place..place + OPEN.len()] == *checksum(file, place).as_bytes())
}

/// Name of a block, which no block of another sweep has.
pub(super) fn block_name(manifest: &Manifest, block: u64) -> String {
    format!("{block} of {} {}", manifest.sweep_hash, manifest.case_hash)
}

/// Where the digits are: the last mark, since metadata come last in a Parquet file.
fn place(file: &[u8]) -> Option<usize> {
    let mark = file.windows(MARK.len()).rposition(|part| part == MARK)?;
    let place = mark + MARK.len();
    (place + OPEN.len() <= file.len()).then_some(place)
}

fn checksum(file: &[u8], place: usize) -> String {
    let mut crc = Crc::new();
    crc.update(&file[..place]);
    crc.update(OPEN);
    crc.update(&file[place + OPEN.len()..]);
    format!("{:08x}", crc.sum())
}

#[cfg(test)]
mod tests {
    use super::{close, is_whole};

    #[test]
    fn a_changed_bit_anywhere_fails_the_checksum() {
        let mut file = b"PAR1 some rows, crc32:11111111, and crc32:00000000 PAR1".to_vec();
        assert!(!is_whole(&file));
        close(&mut file);
        assert!(is_whole(&file));
        for bit in 0..8 * file.len() {
            file[bit / 8] ^= 1 << (bit % 8);
            assert!(!is_whole(&file), "bit {bit}");
            file[bit / 8] ^= 1 << (bit % 8);
        }
        for length in 0..file.len() {
            assert!(!is_whole(&file[..length]), "{length} bytes");
        }
    }
}
