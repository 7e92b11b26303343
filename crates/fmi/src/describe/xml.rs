//! Writes XML: elements with and without children.

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, BytesText, Event};
use std::io;

/// Names and values of attributes.
pub type Attributes<'a> = [(&'a str, String)];

/// A writer that knows elements with and without children.
pub struct Xml(Writer<Vec<u8>>);

impl Xml {
    /// An empty document.
    ///
    /// # Errors
    /// None.
    pub fn new() -> io::Result<Self> {
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
        Ok(Self(writer))
    }

    /// The text.
    ///
    /// # Errors
    /// None: what was written is UTF-8.
    pub fn finish(self) -> io::Result<String> {
        let text = String::from_utf8(self.0.into_inner()).map_err(io::Error::other)?;
        Ok(text + "\n")
    }

    /// An element without children.
    ///
    /// # Errors
    /// None: writing to memory does not fail. The others likewise.
    pub fn leaf(&mut self, name: &str, attributes: &Attributes) -> io::Result<()> {
        let pairs = attributes.iter().map(|(key, value)| (*key, value.as_str()));
        self.0.create_element(name).with_attributes(pairs).write_empty().map(drop)
    }

    /// An element around what `children` writes.
    ///
    /// # Errors
    /// Those of `children`.
    pub fn parent(
        &mut self,
        name: &str,
        attributes: &Attributes,
        children: impl FnOnce(&mut Self) -> io::Result<()>,
    ) -> io::Result<()> {
        let pairs = attributes.iter().map(|(key, value)| (*key, value.as_str()));
        self.0.write_event(Event::Start(BytesStart::new(name).with_attributes(pairs)))?;
        children(self)?;
        self.0.write_event(Event::End(BytesEnd::new(name)))
    }

    /// A comment.
    ///
    /// # Errors
    /// None.
    pub fn comment(&mut self, text: &str) -> io::Result<()> {
        self.0.write_event(Event::Comment(BytesText::new(&format!(" {text} "))))
    }
}
