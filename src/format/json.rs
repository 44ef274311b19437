//! JSON: values as a tree, a reader, and the only writer.
//!
//! Scenarios and measurements are read through it. It is here because of its size, which the page loads: serde_json brings
//! a reader and a writer of numbers of its own, each with a table of powers of ten as large as the standard library's. Here
//! the standard library reads and writes the numbers, as in every other text of the project: with the fewest digits that
//! read back to the same bits.
//!
//! ```
//! use ringroad::format::json::Json;
//!
//! let json: Json = r#"{"b": [1.50, null], "a": "x"}"#.parse().unwrap();
//! assert_eq!(json.to_string(), r#"{"a":"x","b":[1.5,null]}"#); // names in their order
//! let broken = "[1,".parse::<Json>().unwrap_err();
//! assert_eq!(broken.to_string(), "the text ends at line 1 column 4");
//! ```

use crate::error::Error;
use crate::format::json_writer::Writer;
use serde::{Serialize, Serializer};
use std::fmt;
use std::str::FromStr;

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Json {
    /// `null`.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// A finite number. Whole ones are exact to 2^53.
    Number(f64),
    /// A text.
    Text(String),
    /// A list.
    List(Vec<Json>),
    /// Values by name.
    Object(Object),
}

/// Values by name, in the order of the names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Object(Vec<(String, Json)>);

impl Object {
    /// The value of that name.
    pub fn get(&self, name: &str) -> Option<&Json> {
        self.0.iter().find(|(n, _)| n == name).map(|(_, value)| value)
    }

    /// Sets the value of that name.
    pub fn insert(&mut self, name: &str, value: impl Into<Json>) {
        self.put(name, value.into());
    }

    fn put(&mut self, name: &str, value: Json) {
        let place = self.0.iter().position(|(n, _)| n.as_str() >= name).unwrap_or(self.0.len());
        match self.0.get_mut(place) {
            Some((n, old)) if n == name => *old = value,
            _ => self.0.insert(place, (name.to_owned(), value)),
        }
    }

    /// Reads a text that must be an object; a refusal names `what` it is.
    pub fn read(what: &'static str, text: &str) -> Result<Self, Error> {
        match text.parse() {
            Ok(Json::Object(object)) => Ok(object),
            Ok(other) => Err(Error::malformed(what, other, "a JSON object")),
            Err(e) => Err(Error::malformed(what, format!("broken JSON ({e})"), "a JSON object")),
        }
    }

    /// Names with their values.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Json)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }
}

impl Json {
    /// An object of these values.
    pub fn object<const N: usize>(values: [(&str, Self); N]) -> Self {
        Self::gathered(Vec::from(values))
    }

    fn gathered(values: Vec<(&str, Self)>) -> Self {
        let mut object = Object::default();
        for (name, value) in values {
            object.put(name, value);
        }
        Self::Object(object)
    }

    /// The number, if it is one.
    pub fn as_number(&self) -> Option<f64> {
        if let Self::Number(x) = self { Some(*x) } else { None }
    }

    /// The text, if it is one.
    pub fn as_text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    /// The list, if it is one.
    pub fn as_list(&self) -> Option<&[Self]> {
        if let Self::List(list) = self { Some(list) } else { None }
    }
}

impl From<bool> for Json {
    fn from(value: bool) -> Self {
        Self::Bool(value)
    }
}
impl From<f64> for Json {
    /// NaN and infinities, for which JSON has no number, become `null`.
    fn from(value: f64) -> Self {
        if value.is_finite() { Self::Number(value) } else { Self::Null }
    }
}
impl From<usize> for Json {
    fn from(value: usize) -> Self {
        Self::Number(value as f64)
    }
}
impl From<u64> for Json {
    fn from(value: u64) -> Self {
        Self::Number(value as f64)
    }
}
impl From<&str> for Json {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}
impl From<String> for Json {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}
impl From<Object> for Json {
    fn from(object: Object) -> Self {
        Self::Object(object)
    }
}
impl<T: Into<Json>> From<Option<T>> for Json {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Null, Into::into)
    }
}
impl<T: Into<Json>> FromIterator<T> for Json {
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        Self::List(values.into_iter().map(Into::into).collect())
    }
}

// ---- Writing ---------------------------------------------------------------------------------------------------

impl Serialize for Json {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Null => serializer.serialize_unit(),
            Self::Bool(value) => serializer.serialize_bool(*value),
            // Whole numbers without ".0": shorter, and the same number to every reader. Whole numbers have no −0.
            Self::Number(x) if *x == x.trunc() && x.abs() < 9.1e15 && x.to_bits() != (-0.0_f64).to_bits() => {
                serializer.serialize_i64(*x as i64)
            }
            Self::Number(x) => serializer.serialize_f64(*x),
            Self::Text(text) => serializer.serialize_str(text),
            Self::List(list) => serializer.collect_seq(list),
            Self::Object(object) => serializer.collect_map(object.iter()),
        }
    }
}

/// One line of JSON.
pub fn text(value: &impl Serialize) -> String {
    let mut writer = Writer::default();
    // Plain data and memory: neither fails.
    let _ = value.serialize(&mut writer);
    writer.out
}

impl fmt::Display for Json {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&text(self))
    }
}

// ---- Reading ---------------------------------------------------------------------------------------------------

/// Why a text cannot be read as JSON, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// What is wrong.
    pub what: &'static str,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
}

impl fmt::Display for Broken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at line {} column {}", self.what, self.line, self.column)
    }
}

/// The most lists and objects that may stand inside one another.
const DEPTH: usize = 100;

impl FromStr for Json {
    type Err = Broken;
    fn from_str(text: &str) -> Result<Self, Broken> {
        let mut reader = Reader { text, at: 0 };
        reader.document().map_err(|what| {
            let lines = text.as_bytes()[..reader.at].split(|&b| b == b'\n');
            let column = 1 + lines.clone().next_back().map_or(0, <[u8]>::len);
            Broken { what, line: lines.count(), column }
        })
    }
}

struct Reader<'a> {
    text: &'a str,
    /// The next byte.
    at: usize,
}

impl Reader<'_> {
    fn document(&mut self) -> Result<Json, &'static str> {
        let value = self.value(0)?;
        self.skip_space();
        if self.peek().is_some() { Err("something after the end") } else { Ok(value) }
    }

    fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or_default()
    }

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn skip_space(&mut self) {
        while self.peek().is_some_and(|b| b" \t\r\n".contains(&b)) {
            self.at += 1;
        }
    }

    /// Goes past the byte if it is the next one, and says whether it was.
    fn take(&mut self, byte: u8) -> bool {
        let found = self.peek() == Some(byte);
        self.at += usize::from(found);
        found
    }

    fn value(&mut self, depth: usize) -> Result<Json, &'static str> {
        if depth > DEPTH {
            return Err("too many lists in lists");
        }
        self.skip_space();
        match self.peek() {
            None => Err("the text ends"),
            Some(b'{') => self.object(depth),
            Some(b'[') => self.list(depth),
            Some(b'"') => self.string().map(Json::Text),
            Some(b'-' | b'0'..=b'9') => self.number(),
            _ => {
                let words = [("null", Json::Null), ("true", Json::Bool(true)), ("false", Json::Bool(false))];
                let found = words.into_iter().find(|(word, _)| self.rest().starts_with(word));
                let (word, value) = found.ok_or("no value")?;
                self.at += word.len();
                Ok(value)
            }
        }
    }

    fn list(&mut self, depth: usize) -> Result<Json, &'static str> {
        self.at += 1;
        let mut list = Vec::new();
        self.skip_space();
        if self.take(b']') {
            return Ok(Json::List(list));
        }
        loop {
            list.push(self.value(depth + 1)?);
            self.skip_space();
            if self.take(b']') {
                return Ok(Json::List(list));
            }
            if !self.take(b',') {
                return Err("no , or ]");
            }
        }
    }

    fn object(&mut self, depth: usize) -> Result<Json, &'static str> {
        self.at += 1;
        let mut object = Object::default();
        self.skip_space();
        if self.take(b'}') {
            return Ok(Json::Object(object));
        }
        loop {
            self.skip_space();
            let name = if self.peek() == Some(b'"') { self.string()? } else { return Err("no name") };
            self.skip_space();
            if !self.take(b':') {
                return Err("no :");
            }
            let value = self.value(depth + 1)?;
            object.put(&name, value);
            self.skip_space();
            if self.take(b'}') {
                return Ok(Json::Object(object));
            }
            if !self.take(b',') {
                return Err("no , or }");
            }
        }
    }

    /// Goes past digits, of which there must be one or more.
    fn digits(&mut self) -> Result<(), &'static str> {
        let start = self.at;
        while self.peek().is_some_and(|b| b.is_ascii_digit()) {
            self.at += 1;
        }
        if self.at == start { Err("no digit") } else { Ok(()) }
    }

    fn number(&mut self) -> Result<Json, &'static str> {
        let start = self.at;
        self.take(b'-');
        // Only the number 0 itself begins with the digit 0.
        if !self.take(b'0') {
            self.digits()?;
        }
        if self.take(b'.') {
            self.digits()?;
        }
        if self.take(b'e') || self.take(b'E') {
            let _ = self.take(b'+') || self.take(b'-');
            self.digits()?;
        }
        let number = self.text.get(start..self.at).and_then(|text| text.parse().ok());
        number.filter(|x| f64::is_finite(*x)).map(Json::Number).ok_or("number out of range")
    }

    fn string(&mut self) -> Result<String, &'static str> {
        self.at += 1;
        let mut out = String::new();
        loop {
            let rest = self.rest();
            let end = rest.find(|c| c == '"' || c == '\\' || c < ' ').unwrap_or(rest.len());
            out.push_str(rest.get(..end).unwrap_or_default());
            self.at += end;
            if self.take(b'"') {
                return Ok(out);
            }
            if !self.take(b'\\') {
                return Err(if self.peek().is_some() { "a control character" } else { "the text ends" });
            }
            let escape = self.peek().ok_or("the text ends")?;
            self.at += 1;
            out.push(match escape {
                b'"' | b'\\' | b'/' => char::from(escape),
                b'b' => '\u{8}',
                b'f' => '\u{c}',
                b'n' => '\n',
                b'r' => '\r',
                b't' => '\t',
                b'u' => self.character()?,
                _ => return Err("no such escape"),
            });
        }
    }

    /// The character after `\u`: four hexadecimal digits, twice for one beyond U+FFFF.
    fn character(&mut self) -> Result<char, &'static str> {
        let first = self.unit()?;
        let pair = (0xd800..0xdc00).contains(&first) && self.take(b'\\') && self.take(b'u');
        let second = if pair { self.unit()? } else { 0 };
        char::decode_utf16([first, second]).next().and_then(Result::ok).ok_or("no such character")
    }

    fn unit(&mut self) -> Result<u16, &'static str> {
        let digits = self.text.get(self.at..self.at + 4).filter(|d| d.bytes().all(|b| b.is_ascii_hexdigit()));
        let unit =
            digits.and_then(|d| u16::from_str_radix(d, 16).ok()).ok_or("no four hexadecimal digits")?;
        self.at += 4;
        Ok(unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_json_reads_back() {
        for json in [
            "null",
            "[]",
            "{}",
            "[true,false,null]",
            r#"{"a":[1,-2.5,1e-7,5e-324,1e300,9007199254740991],"b":{"c":"\"\\\n\u0001é𝄞"},"d":""}"#,
        ] {
            assert_eq!(json.parse::<Json>().unwrap().to_string(), json);
        }
        for x in [0.1, -0.0, 1.0 / 3.0, f64::MAX, f64::MIN_POSITIVE, 123_456_789.25, 1e22, 4e-5] {
            let read = text(&Json::from(x)).parse::<Json>().unwrap().as_number().unwrap();
            assert_eq!(read.to_bits(), x.to_bits(), "{x}");
        }
        assert_eq!(text(&Json::from(0.0)), "0");
        assert_eq!(text(&[f64::NAN, 0.5]), "[null,0.5]");
    }

    /// The other reader is that of serde_json, which the page does not load.
    #[test]
    fn texts_are_read_or_refused_as_by_serde_json() {
        for json in [
            r#" { "b" : 1.50 , "a" : [ 1E2 , -0.5e-3 , 0 ] , "b" : 2 } "#,
            r#""\u00e9\ud834\udd1e\b\f\/""#,
            "\t[\r\n]",
            "",
            " ",
            "{",
            "[1,]",
            "[1 2]",
            r#"{"a"}"#,
            r#"{"a":1,}"#,
            "{a:1}",
            "01",
            "1.",
            ".5",
            "+1",
            "-",
            "1e",
            "1e999",
            "nul",
            "nullnull",
            "1 1",
            r#""a"#,
            r#""\x""#,
            r#""\u12"#,
            r#""\ud834""#,
            r#""\ud834\u0041""#,
            r#""\udd1e""#,
            "\"\n\"",
            "é",
        ] {
            let theirs = serde_json::from_str::<serde_json::Value>(json);
            let ours = json.parse::<Json>();
            assert_eq!(ours.is_ok(), theirs.is_ok(), "{json}: {ours:?}, {theirs:?}");
            if let (Ok(ours), Ok(theirs)) = (ours, theirs) {
                assert_eq!(theirs.to_string().parse::<Json>(), Ok(ours), "{json}");
            }
        }
        assert!("[".repeat(100_000).parse::<Json>().is_err());
    }

    #[test]
    fn a_refusal_names_line_and_column() {
        let broken = "{\n  \"a\": x}".parse::<Json>().unwrap_err();
        assert_eq!(broken.to_string(), "no value at line 2 column 8");
        assert_eq!("{".parse::<Json>().unwrap_err().to_string(), "no name at line 1 column 2");
    }
}
