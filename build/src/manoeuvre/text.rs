//! Decodes text: UTF-8 with or without a byte order mark, or UTF-16 with one, as spreadsheets write it.

use anyhow::{Result, bail};

/// The text without its byte order mark; `file` is its name in messages.
pub fn decode(bytes: &[u8], file: &str) -> Result<String> {
    match bytes {
        // The mark of UTF-32 starts with that of UTF-16.
        [0xff, 0xfe, 0, 0, ..] => {
            bail!("{file}: the text is in UTF-32; save the file as CSV in UTF-8")
        }
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes, file),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes, file),
        [0xef, 0xbb, 0xbf, rest @ ..] => utf8(rest, file),
        _ => utf8(bytes, file),
    }
}

fn utf8(bytes: &[u8], file: &str) -> Result<String> {
    let ending = |bytes: &[u8]| 1 + bytes.iter().filter(|byte| **byte == b'\n').count();
    match std::str::from_utf8(bytes) {
        Ok(text) => match bytes.iter().position(|byte| *byte == 0) {
            None => Ok(text.to_string()),
            Some(at) => bail!(
                "{file}, line {}: a zero byte, which text cannot contain; save the file as CSV in UTF-8",
                ending(&bytes[..at])
            ),
        },
        Err(error) => bail!(
            "{file}, line {}: the text is not in UTF-8; save the file as CSV in UTF-8",
            ending(&bytes[..error.valid_up_to()])
        ),
    }
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16, file: &str) -> Result<String> {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let text: Result<String, _> = char::decode_utf16(pairs.iter().copied().map(unit)).collect();
    match text {
        Ok(text) if rest.is_empty() && !text.contains('\0') => Ok(text),
        _ => bail!("{file}: the text starts as UTF-16 but is damaged; save the file again"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf_8_and_utf_16_are_read_and_the_rest_is_refused_with_the_line() {
        let text = "time,phi\n0,0 µ\n";
        let little: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let big: Vec<u8> = text.encode_utf16().flat_map(u16::to_be_bytes).collect();
        for bytes in [
            text.as_bytes(),
            &[b"\xef\xbb\xbf", text.as_bytes()].concat(),
            &[b"\xff\xfe", little.as_slice()].concat(),
            &[b"\xfe\xff", big.as_slice()].concat(),
        ] {
            assert_eq!(decode(bytes, "a.csv").unwrap(), text);
        }
        for (bytes, expected) in [
            (b"time\n0\n\xb0".as_slice(), "a.csv, line 3: the text is not in UTF-8"),
            (b"time\n\0".as_slice(), "a.csv, line 2: a zero byte"),
            (b"\xff\xfet".as_slice(), "a.csv: the text starts as UTF-16 but is damaged"),
            (b"\xff\xfet\0\0\0".as_slice(), "a.csv: the text starts as UTF-16 but is damaged"),
            (b"\xff\xfe\0\0t\0\0\0".as_slice(), "a.csv: the text is in UTF-32"),
        ] {
            let message = decode(bytes, "a.csv").unwrap_err().to_string();
            assert!(message.starts_with(expected), "{message}");
        }
    }
}
