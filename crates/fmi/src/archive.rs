//! The zip file.

use std::collections::BTreeMap;
use std::io::{Cursor, Write};
use zip::result::ZipError;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipWriter};

/// Plain zip that every unzipper reads: deflate, sorted names, one date, no zip64. The same files
/// give the same bytes.
///
/// # Errors
/// A file of 4 GB or more.
pub fn zip(files: &BTreeMap<String, Vec<u8>>) -> Result<Vec<u8>, ZipError> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        let mode = if name.starts_with("binaries/") { 0o755 } else { 0o644 };
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(9))
            .last_modified_time(DateTime::default())
            .system(System::Unix)
            .unix_permissions(mode);
        zip.start_file(name.as_str(), options)?;
        zip.write_all(content)?;
    }
    Ok(zip.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Little-endian number of two bytes.
    fn word(bytes: &[u8], at: usize) -> u16 {
        u16::from_le_bytes([bytes[at], bytes[at + 1]])
    }

    #[test]
    fn zip_is_plain_and_reproducible() {
        let files = BTreeMap::from([
            ("modelDescription.xml".to_string(), b"<x/>".repeat(100)),
            ("binaries/linux64/ahv.so".to_string(), vec![0; 5000]),
        ]);
        let bytes = zip(&files).unwrap();
        assert_eq!(bytes, zip(&files).unwrap());

        // Fields of a local file header: APPNOTE.TXT 6.3.10, section 4.3.7.
        assert_eq!(&bytes[..4], b"PK\x03\x04");
        assert_eq!(word(&bytes, 4), 20, "version needed is 2.0");
        assert_eq!(word(&bytes, 6) & (1 << 3), 0, "no data descriptor");
        assert_eq!(word(&bytes, 8), 8, "deflate");
        assert_eq!((word(&bytes, 10), word(&bytes, 12)), (0, 0x21), "1980-01-01 00:00");
        assert_eq!(word(&bytes, 28), 0, "no extra field, so no zip64");
        assert!(!bytes.windows(4).any(|four| four == b"PK\x06\x06"), "no zip64 directory");

        let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).unwrap();
        for (index, (name, mode)) in
            [("binaries/linux64/ahv.so", 0o100_755), ("modelDescription.xml", 0o100_644)]
                .into_iter()
                .enumerate()
        {
            let file = archive.by_index(index).unwrap();
            assert_eq!((file.name().unwrap().as_ref(), file.unix_mode()), (name, Some(mode)));
        }
    }
}
