//! A text in TOML as a tree: the part of TOML that data files are written in.
//!
//! A parser for all of TOML would make the library an eighth larger. What is not read is refused with its line:
//! dotted and quoted keys, tables in tables other than in braces, texts of several lines, dates, truth values,
//! whole numbers that are not decimal.

/// Limit of keys and values; a stiffness table with as many stations as a beam has elements fits twice.
const MAX_NODES: usize = 10_000;
/// Limit of lists and tables in each other; a quantity that is a list has two.
const MAX_DEPTH: usize = 4;

/// A value.
#[derive(Debug, PartialEq)]
pub enum Node<'a> {
    /// As it is written, with its escapes.
    Text(&'a str),
    Number(f64),
    List(Vec<Self>),
    Table(Table<'a>),
}

/// Keys with their values, in the order of the text.
#[derive(Debug, Default, PartialEq)]
pub struct Table<'a>(pub Vec<(&'a str, Node<'a>)>);

/// A line, from 1 on, and what is wrong there.
#[derive(Debug, PartialEq)]
pub struct SyntaxError {
    pub line: usize,
    pub problem: String,
}

/// Reads a text.
pub fn parse(text: &str) -> Result<Table<'_>, SyntaxError> {
    let mut parser = Parser { rest: text.strip_prefix('\u{feff}').unwrap_or(text), nodes: 0 };
    parser.document().map_err(|problem| {
        let read = &text.as_bytes()[..text.len() - parser.rest.len()];
        SyntaxError { line: 1 + read.iter().filter(|&&byte| byte == b'\n').count(), problem }
    })
}

impl<'a> Table<'a> {
    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&Node<'a>> {
        self.0.iter().find(|(known, _)| *known == key).map(|(_, node)| node)
    }

    fn insert(&mut self, key: &'a str, node: Node<'a>) -> Result<(), String> {
        if self.get(key).is_some() {
            return Err(format!("{key} is there twice"));
        }
        self.0.push((key, node));
        Ok(())
    }

    /// The table of the last header.
    fn last(&mut self) -> Option<&mut Self> {
        match self.0.last_mut()? {
            (_, Node::Table(table)) => Some(table),
            (_, Node::List(rows)) => match rows.last_mut() {
                Some(Node::Table(table)) => Some(table),
                _ => None,
            },
            _ => None,
        }
    }
}

struct Parser<'a> {
    rest: &'a str,
    nodes: usize,
}

impl<'a> Parser<'a> {
    fn document(&mut self) -> Result<Table<'a>, String> {
        let mut root = Table::default();
        let mut below_header = false;
        loop {
            self.blank()?;
            if self.rest.is_empty() {
                return Ok(root);
            }
            if self.skips("[[") {
                let key = self.key()?;
                self.expect("]]")?;
                self.count()?;
                let row = Node::Table(Table::default());
                match root.0.last_mut() {
                    Some((last, Node::List(rows))) if *last == key && below_header => {
                        rows.push(row)
                    }
                    _ => root.insert(key, Node::List(vec![row]))?,
                }
                below_header = true;
            } else if self.skips("[") {
                let key = self.key()?;
                self.expect("]")?;
                self.count()?;
                root.insert(key, Node::Table(Table::default()))?;
                below_header = true;
            } else {
                let (key, node) = self.entry(0)?;
                let table = if below_header { root.last() } else { Some(&mut root) };
                table.ok_or("no table is open")?.insert(key, node)?;
            }
            self.end_of_line()?;
        }
    }

    fn skips(&mut self, start: &str) -> bool {
        let rest = self.rest.strip_prefix(start);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn expect(&mut self, start: &str) -> Result<(), String> {
        if self.skips(start) { Ok(()) } else { Err(format!("{start} is expected")) }
    }

    fn count(&mut self) -> Result<(), String> {
        self.nodes += 1;
        if self.nodes > MAX_NODES {
            return Err(format!("there are more than {MAX_NODES} values"));
        }
        Ok(())
    }

    /// Takes what comes before the first character that does not belong to it.
    fn take(&mut self, belongs: impl Fn(char) -> bool) -> &'a str {
        let end = self.rest.find(|c| !belongs(c)).unwrap_or(self.rest.len());
        let (taken, rest) = self.rest.split_at(end);
        self.rest = rest;
        taken
    }

    fn spaces(&mut self) {
        self.take(|c| c == ' ' || c == '\t');
    }

    fn comment(&mut self) -> Result<(), String> {
        if self.rest.starts_with('#') {
            self.take(is_printable);
            if !self.rest.is_empty() && !self.rest.starts_with(['\n', '\r']) {
                return Err("a comment has a control character".to_string());
            }
        }
        Ok(())
    }

    /// Spaces, comments and ends of lines.
    fn blank(&mut self) -> Result<(), String> {
        loop {
            self.spaces();
            self.comment()?;
            if !self.skips("\n") && !self.skips("\r\n") {
                return Ok(());
            }
        }
    }

    fn end_of_line(&mut self) -> Result<(), String> {
        self.spaces();
        self.comment()?;
        if !self.rest.is_empty() && !self.rest.starts_with('\n') && !self.rest.starts_with("\r\n") {
            return Err("the end of the line is expected".to_string());
        }
        Ok(())
    }

    fn key(&mut self) -> Result<&'a str, String> {
        self.spaces();
        let key = self.take(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
        if key.is_empty() {
            return Err("a key of letters, digits, _ and - is expected".to_string());
        }
        self.spaces();
        Ok(key)
    }

    fn entry(&mut self, depth: usize) -> Result<(&'a str, Node<'a>), String> {
        let key = self.key()?;
        self.expect("=")?;
        self.spaces();
        Ok((key, self.value(depth)?))
    }

    fn value(&mut self, depth: usize) -> Result<Node<'a>, String> {
        self.count()?;
        if depth > MAX_DEPTH {
            return Err(format!("more than {MAX_DEPTH} lists or tables stand in each other"));
        }
        if self.skips("\"") {
            return self.text('"');
        }
        if self.skips("'") {
            return self.text('\'');
        }
        if self.skips("[") {
            let mut list = Vec::new();
            while self.goes_on("]")? {
                list.push(self.value(depth + 1)?);
                self.comma("]")?;
            }
            return Ok(Node::List(list));
        }
        if self.skips("{") {
            let mut table = Table::default();
            while self.goes_on("}")? {
                let (key, node) = self.entry(depth + 1)?;
                table.insert(key, node)?;
                self.comma("}")?;
            }
            return Ok(Node::Table(table));
        }
        let written = self.take(|c| c.is_ascii_alphanumeric() || "+-._:".contains(c));
        match number(written) {
            Some(number) => Ok(Node::Number(number)),
            None => Err(format!("{written} is no number, and no text in quotation marks")),
        }
    }

    /// Whether values follow before the end.
    fn goes_on(&mut self, end: &str) -> Result<bool, String> {
        self.blank()?;
        Ok(!self.skips(end))
    }

    /// Between two values stands a comma, behind the last one there may be one.
    fn comma(&mut self, end: &str) -> Result<(), String> {
        self.blank()?;
        if self.skips(",") || self.rest.starts_with(end) {
            return Ok(());
        }
        Err(format!(", or {end} is expected"))
    }

    fn text(&mut self, quote: char) -> Result<Node<'a>, String> {
        let all = self.rest;
        loop {
            self.take(|c| is_printable(c) && c != quote && (c != '\\' || quote == '\''));
            let length = all.len() - self.rest.len();
            if self.skips("\\") {
                self.escape()?;
            } else if self.skips(if quote == '"' { "\"" } else { "'" }) {
                return Ok(Node::Text(&all[..length]));
            } else {
                return Err("a text has no end on its line, or has a control character".to_string());
            }
        }
    }

    fn escape(&mut self) -> Result<(), String> {
        let kind = self.rest.chars().next().unwrap_or_default();
        let digits = match kind {
            'b' | 't' | 'n' | 'f' | 'r' | 'e' | '"' | '\\' => 0,
            'x' => 2,
            'u' => 4,
            'U' => 8,
            _ => return Err("a backslash stands before what it cannot escape".to_string()),
        };
        self.rest = &self.rest[1..];
        match self.rest.get(..digits).map(|code| u32::from_str_radix(code, 16).map(char::from_u32))
        {
            _ if digits == 0 => {}
            Some(Ok(Some(_))) if !self.rest.starts_with('+') => self.rest = &self.rest[digits..],
            _ => return Err("an escape has not the digits of a character".to_string()),
        }
        Ok(())
    }
}

fn is_printable(c: char) -> bool {
    c == '\t' || !c.is_ascii_control()
}

/// A decimal number as TOML writes it, whole or not.
fn number(written: &str) -> Option<f64> {
    let size = written.strip_prefix(['+', '-']).unwrap_or(written);
    if size != "inf" && size != "nan" {
        let (mantissa, power) = match size.split_once(['e', 'E']) {
            Some((mantissa, power)) => (mantissa, Some(power)),
            None => (size, None),
        };
        let (whole, fraction) = match mantissa.split_once('.') {
            Some((whole, fraction)) => (whole, Some(fraction)),
            None => (mantissa, None),
        };
        let power = power.map(|power| power.strip_prefix(['+', '-']).unwrap_or(power));
        let has_zero_before = whole.len() > 1 && whole.starts_with('0');
        let parts = [Some(whole), fraction, power];
        if has_zero_before || !parts.into_iter().flatten().all(are_digits) {
            return None;
        }
        // Larger ones are refused everywhere else, too.
        if fraction.is_none() && power.is_none() {
            written.replace('_', "").parse::<i64>().ok()?;
        }
    }
    written.replace('_', "").parse().ok()
}

/// Digits, with single underscores between them.
fn are_digits(text: &str) -> bool {
    text.split('_').all(|part| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit()))
}
