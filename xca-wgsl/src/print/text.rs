//! Pieces of text that know where they need parentheses.

/// How tightly an expression holds together. WGSL allows fewer mixtures than Rust; where it does not, or
/// where a reader would have to think, there are parentheses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Level {
    Or,
    And,
    Bitwise,
    Relational,
    Shift,
    Additive,
    Multiplicative,
    Unary,
    Primary,
}

/// An expression of WGSL.
#[derive(Debug, Clone)]
pub(super) struct Text {
    text: String,
    level: Level,
}

impl Text {
    pub(super) fn new(text: impl Into<String>, level: Level) -> Self {
        Self { text: text.into(), level }
    }

    pub(super) fn primary(text: impl Into<String>) -> Self {
        Self::new(text, Level::Primary)
    }

    /// A literal or a call, which may begin with a minus sign.
    pub(super) fn number(text: String) -> Self {
        let level = if text.starts_with('-') { Level::Unary } else { Level::Primary };
        Self { text, level }
    }

    /// Where nothing stands around it.
    pub(super) fn plain(&self) -> &str {
        &self.text
    }

    /// As one of several arguments: a `<` there could be taken for the beginning of a list of types.
    pub(super) fn argument(&self) -> String {
        if self.level <= Level::Relational { format!("({})", self.text) } else { self.text.clone() }
    }

    /// Beside operators: with parentheses where it holds together less tightly than `least`.
    pub(super) fn at_least(&self, least: Level) -> String {
        if self.level < least { format!("({})", self.text) } else { self.text.clone() }
    }

    /// To the right of an operator, where a leading minus sign gets parentheses too.
    pub(super) fn right_of(&self, least: Level) -> String {
        if self.level < least || self.text.starts_with('-') {
            format!("({})", self.text)
        } else {
            self.text.clone()
        }
    }

    /// `left operator right` of one level, grouped from the left.
    pub(super) fn joined(left: &Self, operator: &str, right: &Self, level: Level) -> Self {
        let (least_left, least_right) = match level {
            Level::Multiplicative => (Level::Multiplicative, Level::Unary),
            Level::Additive => (Level::Additive, Level::Multiplicative),
            Level::Shift | Level::Bitwise => (Level::Unary, Level::Unary),
            Level::Relational => (Level::Additive, Level::Additive),
            Level::And => (Level::And, Level::Relational),
            Level::Or => (Level::Or, Level::Relational),
            Level::Unary | Level::Primary => (Level::Primary, Level::Primary),
        };
        // `a || b` and `a && b` may follow themselves, but not each other, nor a bitwise operator.
        let least_left = match level {
            Level::And if left.level == Level::Bitwise => Level::Primary,
            Level::Or if matches!(left.level, Level::And | Level::Bitwise) => Level::Primary,
            _ => least_left,
        };
        Self::new(format!("{} {operator} {}", left.at_least(least_left), right.right_of(least_right)), level)
    }

    pub(super) fn negated(&self) -> Self {
        let operand = self.right_of(Level::Primary);
        Self::new(format!("-{operand}"), Level::Unary)
    }

    /// With `!` or `~`.
    pub(super) fn inverted(&self, sign: &str) -> Self {
        Self::new(format!("{sign}{}", self.right_of(Level::Primary)), Level::Unary)
    }
}

#[cfg(test)]
mod tests {
    use super::{Level, Text};

    #[test]
    fn parentheses() {
        let [a, b, c] = ["a", "b", "c"].map(Text::primary);
        let sum = Text::joined(&a, "+", &b, Level::Additive);
        assert_eq!(Text::joined(&sum, "+", &c, Level::Additive).plain(), "a + b + c");
        assert_eq!(Text::joined(&c, "-", &sum, Level::Additive).plain(), "c - (a + b)");
        assert_eq!(Text::joined(&sum, "*", &c, Level::Multiplicative).plain(), "(a + b) * c");
        assert_eq!(sum.negated().negated().plain(), "-(-(a + b))");
        let or = Text::joined(&a, "||", &b, Level::Or);
        assert_eq!(Text::joined(&or, "&&", &c, Level::And).plain(), "(a || b) && c");
        let and = Text::joined(&a, "&&", &b, Level::And);
        assert_eq!(Text::joined(&and, "&&", &c, Level::And).plain(), "a && b && c");
        assert_eq!(Text::joined(&and, "||", &c, Level::Or).plain(), "(a && b) || c");
        let mask = Text::joined(&sum, "&", &c, Level::Bitwise);
        assert_eq!(Text::joined(&mask, "==", &a, Level::Relational).plain(), "((a + b) & c) == a");
    }
}
