//! Writes plain data as one line of JSON: a `serde` serializer that is made small, because the page loads it.
//!
//! Every name and every value goes through the same few functions, which are not inlined; so each field of a struct
//! costs the module two calls. Numbers are written by the standard library with the fewest digits that read back to
//! the same bits; what is not finite becomes `null`.

use serde::ser::{
    Serialize, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant, Serializer,
};
use std::fmt::{Error, Write as _};

/// The text so far.
#[derive(Default)]
pub(crate) struct Writer {
    /// What is written.
    pub(crate) out: String,
}

type Done = Result<(), Error>;

impl Writer {
    #[inline(never)]
    #[allow(clippy::unnecessary_wraps)] // as the methods of a serializer return it
    fn put(&mut self, text: &str) -> Done {
        self.out.push_str(text);
        Ok(())
    }

    #[inline(never)]
    fn text(&mut self, text: &str) -> Done {
        self.out.push('"');
        for c in text.chars() {
            match c {
                '"' => self.out.push_str("\\\""),
                '\\' => self.out.push_str("\\\\"),
                '\u{8}' => self.out.push_str("\\b"),
                '\u{c}' => self.out.push_str("\\f"),
                '\n' => self.out.push_str("\\n"),
                '\r' => self.out.push_str("\\r"),
                '\t' => self.out.push_str("\\t"),
                c if c < ' ' => write!(self.out, "\\u{:04x}", u32::from(c))?,
                c => self.out.push(c),
            }
        }
        self.out.push('"');
        Ok(())
    }

    /// The comma before all items but the first: the text then ends with the bracket that opens them.
    #[inline(never)]
    fn next(&mut self) {
        if !self.out.ends_with(['[', '{']) {
            self.out.push(',');
        }
    }

    #[inline(never)]
    fn name(&mut self, name: &str) -> Done {
        self.next();
        self.text(name)?;
        self.put(":")
    }

    /// The name of an enum's variant that holds values, and what opens these.
    #[inline(never)]
    fn variant(&mut self, name: &str, open: &str) -> Done {
        self.put("{")?;
        self.name(name)?;
        self.put(open)
    }

    #[inline(never)]
    fn whole(&mut self, value: u64) -> Done {
        write!(self.out, "{value}")
    }

    #[inline(never)]
    fn float(&mut self, value: f64) -> Done {
        if value.is_finite() { write!(self.out, "{value:?}") } else { self.put("null") }
    }
}

/// Items between two brackets.
pub(crate) struct Items<'a> {
    writer: &'a mut Writer,
    close: &'static str,
}

impl<'a> Serializer for &'a mut Writer {
    type Ok = ();
    type Error = Error;
    type SerializeSeq = Items<'a>;
    type SerializeTuple = Items<'a>;
    type SerializeTupleStruct = Items<'a>;
    type SerializeTupleVariant = Items<'a>;
    type SerializeMap = Items<'a>;
    type SerializeStruct = Items<'a>;
    type SerializeStructVariant = Items<'a>;

    fn serialize_bool(self, v: bool) -> Done {
        self.put(if v { "true" } else { "false" })
    }
    fn serialize_i8(self, v: i8) -> Done {
        self.serialize_i64(v.into())
    }
    fn serialize_i16(self, v: i16) -> Done {
        self.serialize_i64(v.into())
    }
    fn serialize_i32(self, v: i32) -> Done {
        self.serialize_i64(v.into())
    }
    fn serialize_i64(self, v: i64) -> Done {
        if v < 0 {
            self.put("-")?;
        }
        self.whole(v.unsigned_abs())
    }
    fn serialize_u8(self, v: u8) -> Done {
        self.whole(v.into())
    }
    fn serialize_u16(self, v: u16) -> Done {
        self.whole(v.into())
    }
    fn serialize_u32(self, v: u32) -> Done {
        self.whole(v.into())
    }
    fn serialize_u64(self, v: u64) -> Done {
        self.whole(v)
    }
    fn serialize_f32(self, v: f32) -> Done {
        if v.is_finite() { write!(self.out, "{v:?}") } else { self.put("null") }
    }
    fn serialize_f64(self, v: f64) -> Done {
        self.float(v)
    }
    fn serialize_char(self, v: char) -> Done {
        self.text(v.encode_utf8(&mut [0; 4]))
    }
    fn serialize_str(self, v: &str) -> Done {
        self.text(v)
    }
    fn serialize_bytes(self, v: &[u8]) -> Done {
        self.collect_seq(v)
    }
    fn serialize_none(self) -> Done {
        self.put("null")
    }
    fn serialize_some<T: ?Sized + Serialize>(self, value: &T) -> Done {
        value.serialize(self)
    }
    fn serialize_unit(self) -> Done {
        self.put("null")
    }
    fn serialize_unit_struct(self, _name: &'static str) -> Done {
        self.put("null")
    }
    fn serialize_unit_variant(self, _name: &'static str, _index: u32, variant: &'static str) -> Done {
        self.text(variant)
    }
    fn serialize_newtype_struct<T: ?Sized + Serialize>(self, _name: &'static str, value: &T) -> Done {
        value.serialize(self)
    }
    fn serialize_newtype_variant<T: ?Sized + Serialize>(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        value: &T,
    ) -> Done {
        self.variant(variant, "")?;
        value.serialize(&mut *self)?;
        self.put("}")
    }
    fn serialize_seq(self, _len: Option<usize>) -> Result<Items<'a>, Error> {
        self.put("[")?;
        Ok(Items { writer: self, close: "]" })
    }
    fn serialize_tuple(self, len: usize) -> Result<Items<'a>, Error> {
        self.serialize_seq(Some(len))
    }
    fn serialize_tuple_struct(self, _name: &'static str, len: usize) -> Result<Items<'a>, Error> {
        self.serialize_seq(Some(len))
    }
    fn serialize_tuple_variant(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        _len: usize,
    ) -> Result<Items<'a>, Error> {
        self.variant(variant, "[")?;
        Ok(Items { writer: self, close: "]}" })
    }
    fn serialize_map(self, _len: Option<usize>) -> Result<Items<'a>, Error> {
        self.put("{")?;
        Ok(Items { writer: self, close: "}" })
    }
    fn serialize_struct(self, _name: &'static str, len: usize) -> Result<Items<'a>, Error> {
        self.serialize_map(Some(len))
    }
    fn serialize_struct_variant(
        self,
        _name: &'static str,
        _index: u32,
        variant: &'static str,
        _len: usize,
    ) -> Result<Items<'a>, Error> {
        self.variant(variant, "{")?;
        Ok(Items { writer: self, close: "}}" })
    }
}

impl Items<'_> {
    fn item<T: ?Sized + Serialize>(&mut self, value: &T) -> Done {
        self.writer.next();
        value.serialize(&mut *self.writer)
    }

    fn field<T: ?Sized + Serialize>(&mut self, name: &'static str, value: &T) -> Done {
        self.writer.name(name)?;
        value.serialize(&mut *self.writer)
    }
}

impl SerializeSeq for Items<'_> {
    type Ok = ();
    type Error = Error;
    fn serialize_element<T: ?Sized + Serialize>(&mut self, value: &T) -> Done {
        self.item(value)
    }
    fn end(self) -> Done {
        self.writer.put(self.close)
    }
}
impl SerializeTuple for Items<'_> {
    type Ok = ();
    type Error = Error;
    fn serialize_element<T: ?Sized + Serialize>(&mut self, value: &T) -> Done {
        self.item(value)
    }
    fn end(self) -> Done {
        self.writer.put(self.close)
    }
}
impl SerializeTupleStruct for Items<'_> {
    type Ok = ();
    type Error = Error;
    fn serialize_field<T: ?Sized + Serialize>(&mut self, value: &T) -> Done {
        self.item(value)
    }
    fn end(self) -> Done {
        self.writer.put(self.close)
    }
}
impl SerializeTupleVariant for Items<'_> {
    type Ok = ();
    type Error = Error;
    fn serialize_field<T: ?Sized + Serialize>(&mut self, value: &T) -> Done {
        self.item(value)
    }
    fn end(self) -> Done {
        self.writer.put(self.close)
    }
}
impl SerializeMap for Items<'_> {
    type Ok = ();
    type Error = Error;
    /// Keys are texts, as everywhere in this program.
    fn serialize_key<T: ?Sized + Serialize>(&mut self, key: &T) -> Done {
        self.item(key)?;
        self.writer.put(":")
    }
    fn serialize_value<T: ?Sized + Serialize>(&mut self, value: &T) -> Done {
        value.serialize(&mut *self.writer)
    }
    fn end(self) -> Done {
        self.writer.put(self.close)
    }
}
impl SerializeStruct for Items<'_> {
    type Ok = ();
    type Error = Error;
    fn serialize_field<T: ?Sized + Serialize>(&mut self, name: &'static str, value: &T) -> Done {
        self.field(name, value)
    }
    fn end(self) -> Done {
        self.writer.put(self.close)
    }
}
impl SerializeStructVariant for Items<'_> {
    type Ok = ();
    type Error = Error;
    fn serialize_field<T: ?Sized + Serialize>(&mut self, name: &'static str, value: &T) -> Done {
        self.field(name, value)
    }
    fn end(self) -> Done {
        self.writer.put(self.close)
    }
}

#[cfg(test)]
mod tests {
    use super::Writer;
    use serde::Serialize;
    use std::collections::BTreeMap;

    #[derive(Serialize)]
    struct Pair(u8, i16);
    #[derive(Serialize)]
    struct Wrapped(f64);
    #[derive(Serialize)]
    struct Unit;
    #[derive(Serialize)]
    enum Plain {
        Nothing,
        One(u64),
        Two(i8, char),
        Named { a: Option<f64>, b: Vec<()> },
    }
    #[derive(Serialize)]
    #[serde(tag = "kind", rename_all = "kebab-case")]
    enum Tagged {
        SomeCurve { x: Vec<f64> },
    }
    #[derive(Serialize)]
    struct All {
        text: String,
        empty: Vec<u32>,
        nested: Vec<Vec<i64>>,
        tuple: (bool, f64, &'static str),
        pair: Pair,
        wrapped: Wrapped,
        unit: Unit,
        plain: Vec<Plain>,
        tagged: Tagged,
        map: BTreeMap<&'static str, Option<bool>>,
        numbers: Vec<f64>,
        singles: Vec<f32>,
    }

    /// The same as another writer gives, which the page does not load.
    #[test]
    fn it_writes_what_serde_json_writes() {
        let all = All {
            text: (0..0x90).filter_map(char::from_u32).chain("é𝄞\u{2028}".chars()).collect(),
            empty: vec![],
            nested: vec![vec![], vec![-1, i64::MIN, i64::MAX], vec![0]],
            tuple: (true, 0.5, "[{"),
            pair: Pair(255, -3),
            wrapped: Wrapped(-0.0),
            unit: Unit,
            plain: vec![
                Plain::Nothing,
                Plain::One(u64::MAX),
                Plain::Two(-128, '"'),
                Plain::Named { a: None, b: vec![(), ()] },
                Plain::Named { a: Some(f64::NAN), b: vec![] },
            ],
            tagged: Tagged::SomeCurve { x: vec![1.0, 2.5] },
            map: BTreeMap::from([("", None), ("a\n", Some(false))]),
            numbers: vec![f64::INFINITY, 1.0, 0.1, 5e-324, 123_456_789.25],
            singles: vec![f32::NAN, 0.1, 2.0],
        };
        let mut writer = Writer::default();
        all.serialize(&mut writer).unwrap();
        assert_eq!(writer.out, serde_json::to_string(&all).unwrap());
    }
}
