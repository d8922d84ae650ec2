"use strict";
// Judges typed numbers as rldrill does: exact, or right to three significant digits. What it is not sure to read as
// rldrill reads it, it calls unreadable; it never calls a right answer wrong because of its spelling.

const Judge = (() => {
  // Why something is not read: a sentence, and what stands in it for each {}
  class Unreadable extends Error {
    constructor(sentence, values) { super(sentence); this.values = values; }
    says(told) { return this.values.reduce((said, value) => said.replace("{}", () => value), told[this.message] ?? this.message); }
  }
  const refuse = (sentence, ...values) => { throw new Unreadable(sentence, values); };

  // Exact quotients, [numerator, denominator] with a positive denominator; anything else is a float.
  const abs = (n) => (n < 0n ? -n : n);
  const gcd = (a, b) => { while (b) [a, b] = [b, a % b]; return a; };
  const quotient = (n, d) => {
    if (d < 0n) [n, d] = [-n, -d];
    const common = gcd(abs(n), d) || 1n;
    return [n / common, d / common];
  };
  const whole = (n) => [BigInt(n), 1n];
  const isExact = (value) => Array.isArray(value);
  const SIZE = 10n ** 15n;
  const float = (value) => {
    if (!isExact(value)) return value;
    const [n, d] = value;
    if (abs(n) < SIZE && d < SIZE) return Number(n) / Number(d);
    const whole_ = n / d;
    const rough = Number(whole_) + Number(((n - whole_ * d) * SIZE) / d) / Number(SIZE);
    return Number.isFinite(rough) ? rough : refuse("A number in it is too large.");
  };
  const finite = (value) => (isExact(value) || Number.isFinite(value) ? value : refuse("A part of it is no real number."));
  const either = (exact, rough, ofRatios) => (a, b) => (a instanceof Ratio || b instanceof Ratio
    ? ofRatios(Ratio.of(a), Ratio.of(b))
    : finite(isExact(a) && isExact(b) ? exact(a, b) : rough(float(a), float(b))));
  const add = either(([a, b], [c, d]) => quotient(a * d + c * b, b * d), (a, b) => a + b, (a, b) => a.plus(b, add));
  const subtract = either(([a, b], [c, d]) => quotient(a * d - c * b, b * d), (a, b) => a - b, (a, b) => a.plus(b, subtract));
  const multiply = either(([a, b], [c, d]) => quotient(a * c, b * d), (a, b) => a * b, (a, b) => a.times(b));
  const isZero = (value) => (value instanceof Ratio ? !value.top.size : isExact(value) ? value[0] === 0n : value === 0);
  const divide = (a, b) => (isZero(b) ? refuse("It divides by zero.") : divided(a, b));
  const divided = either(([a, b], [c, d]) => quotient(a * d, b * c), (a, b) => a / b, (a, b) => a.times(b.upsideDown()));
  const power = (base, exponent) => {
    if (exponent instanceof Ratio) throw new NoRatio();
    if (base instanceof Ratio) return base.raised(exponent);
    if (isExact(base) && isExact(exponent) && exponent[1] === 1n) {
      const times = abs(exponent[0]);
      if (times > 400n) refuse("The exponent is too large.");
      const [n, d] = [base[0] ** times, base[1] ** times];
      if (exponent[0] >= 0n) return quotient(n, d);
      return n === 0n ? refuse("It divides by zero.") : quotient(d, n);
    }
    return finite(Math.pow(float(base), float(exponent)));
  };

  // Quotients of polynomials in the letters: the numbers before each product of letters, above the line and below
  class Ratio {
    static of(value) {
      return value instanceof Ratio ? value : new Ratio(new Map(isZero(value) ? [] : [["", value]]), new Map([["", whole(1)]]));
    }
    static letter(name) { return new Ratio(new Map([[name, whole(1)]]), new Map([["", whole(1)]])); }
    constructor(top, bottom) { this.top = top; this.bottom = bottom; }
    upsideDown() { return new Ratio(this.bottom, this.top); }
    times(other) { return new Ratio(product(this.top, other.top), product(this.bottom, other.bottom)); }
    plus(other, work) {
      if (same(this.bottom, other.bottom)) return new Ratio(sum(this.top, other.top, work), this.bottom);
      const [ours, theirs] = [product(this.top, other.bottom), product(other.top, this.bottom)];
      return new Ratio(sum(ours, theirs, work), product(this.bottom, other.bottom));
    }
    raised(exponent) {
      if (!isExact(exponent) || exponent[1] !== 1n || abs(exponent[0]) > 20n) throw new NoRatio();
      const factor = exponent[0] < 0n ? this.upsideDown() : this;
      let result = Ratio.of(whole(1));
      for (let times = abs(exponent[0]); times > 0n; times -= 1n) result = result.times(factor);
      return result;
    }
  }
  class NoRatio extends Error {}
  const sum = (one, other, work) => {
    const found = new Map(one);
    for (const [letters, number] of other) found.set(letters, work(found.get(letters) ?? whole(0), number));
    return new Map([...found].filter(([, number]) => !isZero(number)));
  };
  const product = (one, other) => {
    let found = new Map();
    for (const [letters, number] of other) {
      const together = (each) => [...each.split(" "), ...letters.split(" ")].filter(Boolean).sort().join(" ");
      found = sum(found, new Map([...one].map(([each, factor]) => [together(each), multiply(factor, number)])), add);
    }
    return found;
  };
  const same = (one, other) => one.size === other.size && [...one].every(([letters, number]) =>
    other.has(letters) && isZero(subtract(number, other.get(letters))));

  const isqrt = (n) => {
    if (n < 2n) return n;
    let x = BigInt(Math.floor(Math.sqrt(Number(n))));
    while (x * x > n) x -= 1n;
    while ((x + 1n) * (x + 1n) <= n) x += 1n;
    return x;
  };
  const root = (value) => {
    if (value instanceof Ratio) throw new NoRatio();
    if (isExact(value) && value[0] >= 0n && value[0] < SIZE && value[1] < SIZE) {
      const [n, d] = value.map(isqrt);
      if (n * n === value[0] && d * d === value[1]) return quotient(n, d);
    }
    return finite(Math.sqrt(float(value)));
  };
  const FUNCTIONS = {
    sqrt: root,
    exp: (x) => (isZero(x) ? whole(1) : finite(Math.exp(float(x)))),
    ln: (x) => finite(Math.log(float(x))),
    log: (x) => finite(Math.log(float(x))),
    sin: (x) => finite(Math.sin(float(x))),
    cos: (x) => finite(Math.cos(float(x))),
    tan: (x) => finite(Math.abs(Math.cos(float(x))) < 1e-12 ? NaN : Math.tan(float(x))),
  };

  // One spelling
  const ALIKE = {
    "-": "−–—‐‑‒﹣", "*": "×·⋅∙∗⋆✕✖", "/": "÷∕⁄", " ": "\t\u00a0\u2009\u202f", "(": "（", ")": "）", "+": "＋", "=": "＝", ".": "．",
  };
  const SPELLING = Object.fromEntries(Object.entries(ALIKE).flatMap(([one, signs]) => [...signs].map((sign) => [sign, one])));
  const VULGAR = {
    "¼": "1/4", "½": "1/2", "¾": "3/4", "⅓": "1/3", "⅔": "2/3", "⅕": "1/5", "⅖": "2/5", "⅗": "3/5", "⅘": "4/5", "⅙": "1/6",
    "⅚": "5/6", "⅛": "1/8", "⅜": "3/8", "⅝": "5/8", "⅞": "7/8",
  };
  const RAISED = { "⁰": 0, "¹": 1, "²": 2, "³": 3, "⁴": 4, "⁵": 5, "⁶": 6, "⁷": 7, "⁸": 8, "⁹": 9, "⁻": "-" };
  const GREEK = {
    "γ": "gamma", "α": "alpha", "λ": "lambda", "ε": "epsilon", "ϵ": "epsilon", "ρ": "rho", "σ": "sigma", "θ": "theta", "β": "beta", "π": "pi",
  };
  // What LaTeX and programs write around numbers
  const FOREIGN = [
    [/^\s*(\${1,2}|`|"|')(.*)\1\s*$/su, "$2"], [/\\[()]|\\left|\\right|\\,|\\;|\\!/gu, " "], [/\\%/gu, "%"],
    [/(?<![0-9]\s*)\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}/gu, "(($1)/($2))"], [/\\(?:cdot|times)(?![a-z])/gu, "*"],
    [/\\sqrt\s*\{([^{}]*)\}/gu, "sqrt($1)"], [/\^\s*\{([^{}]*)\}/gu, "^($1)"], [/\b(?:np|numpy|math|sympy|sp)\./gu, ""],
    [/\\(gamma|alpha|lambda|epsilon|varepsilon|rho|sigma|theta|beta|pi|exp|ln|log)(?![a-z])/gu, (_, name) => ` ${name.replace("var", "")} `],
    [/([1-9]|[0-9.][0-9.])\s*[xX]\s*(?=[0-9.])/gu, "$1*"],
  ];
  const spelled = (text) => {
    const alike = [...text].map((sign) => SPELLING[sign] ?? sign).join("");
    return FOREIGN.reduce((said, [pattern, by]) => said.replace(pattern, by), alike).trim();
  };

  const TOKEN = new RegExp(
    `\\s*(?:(?<mixed>[0-9]+(?:\\s*[${Object.keys(VULGAR).join("")}]|\\s+[0-9]+\\s*/\\s*[0-9]+(?![0-9.])))`
    + "|(?<number>(?:[0-9]+(?:\\.[0-9]*)?|\\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
    + `|(?<vulgar>[${Object.keys(VULGAR).join("")}])|(?<raised>[${Object.keys(RAISED).join("")}]+)`
    + "|(?<name>[A-Za-z]+|[αβγλεϵρσθπ])|(?<sign>\\*\\*|[-+*/^()%√]))", "uy");

  function tokens(text) {
    const found = [];
    TOKEN.lastIndex = 0;
    while (TOKEN.lastIndex < text.length) {
      const start = TOKEN.lastIndex;
      const match = TOKEN.exec(text);
      if (!match) refuseRest(text.slice(start).trim());
      const [kind, value] = Object.entries(match.groups).find(([, each]) => each !== undefined);
      found.push({ kind: kind === "sign" ? (value === "**" ? "^" : value) : kind, value, spaced: /^\s/.test(match[0]) });
      if (!text.slice(TOKEN.lastIndex).trim()) break;
    }
    return found;
  }

  const refuseRest = (rest) => (rest.startsWith(",")
    ? refuse("A number has a comma in it; write a point before decimals, and nothing between thousands.")
    : refuse("“{}” is not understood; write a number such as 3/4.", rest.slice(0, 20)));

  // Decimal commas; a point is taken for one, too, unless it may part thousands.
  const pointed = (text) => {
    const said = text.replace(/\{,\}/g, ",").replace(/[.,]?[0-9]+(?:[.,][0-9]+)*/g, (number) => {
      const [commas, points] = [",", "."].map((sign) => number.split(sign).length - 1);
      if (commas > 1 || points > 1 || (commas && points) || /^[1-9][0-9]{0,2}\.[0-9]{3}$/.test(number)) {
        refuse("“{}” may be several numbers; write a comma before decimals, and nothing between thousands.", number.slice(0, 20));
      }
      return number.replace(",", ".");
    });
    return said.includes(",") ? refuse("There is a comma that is not within a number; write one number.") : said;
  };

  const decimalValue = (text, longest) => {
    const [mantissa, exponent = "0"] = text.toLowerCase().split("e");
    const [before, after = ""] = mantissa.split(".");
    const shift = Number(exponent) - after.length;
    if (Math.abs(shift) > 300 || text.length > longest) refuse("The number is too long.");
    const digits = BigInt(before + after || "0");
    return shift >= 0 ? [digits * 10n ** BigInt(shift), 1n] : quotient(digits, 10n ** BigInt(-shift));
  };
  const fraction = (text) => { const [n, d] = text.split("/").map((part) => BigInt(part.trim())); return d ? quotient(n, d) : refuse("It divides by zero."); };

  // Sums, products and powers; a sign left out between factors is read only where it can mean one thing.
  class Parser {
    // Keys may be as long as they are; of what is typed no number may.
    constructor(text, parameters, longest = Infinity) {
      this.tokens = tokens(text);
      this.longest = longest;
      this.next = 0;
      this.parameters = parameters;
      this.decimal = false;
    }
    get token() { return this.tokens[this.next] ?? { kind: "end", value: "" }; }
    take(...kinds) { return kinds.includes(this.token.kind) ? this.tokens[this.next++] : null; }
    all() {
      if (!this.tokens.length) refuse("Nothing was typed.");
      const result = this.sum();
      if (this.token.kind !== "end") refuse("“{}” is not expected there.", this.token.value);
      return result;
    }
    sum() {
      let left = this.product();
      for (let sign; (sign = this.take("+", "-"));) {
        const [before, right] = [left, this.product()];
        const work = sign.kind === "+" ? add : subtract;
        left = (at) => work(before(at), right(at));
      }
      return left;
    }
    product() {
      let left = this.signed(), over = false;
      for (;;) {
        const sign = this.take("*", "/");
        const bare = !sign && ["name", "(", "√"].includes(this.token.kind);
        if (!sign && !bare) {
          if (["number", "mixed", "vulgar"].includes(this.token.kind)) refuse("A sign is missing between two numbers.");
          return left;
        }
        if (over && sign?.kind !== "*") refuse("Put brackets around what stands below the line.");
        over = sign?.kind === "/";
        const first = this.token;
        const [before, right] = [left, sign ? this.signed() : this.raised()];
        if (over && this.percent) refuse("Put brackets around what the percent sign belongs to.");
        if (first.value === "10" && this.isSign() && this.tokens[this.next + 1]?.spaced === false) refuse("Write powers of ten with ^: 10^-3.");
        if (!sign && first.value.toLowerCase() === "e" && this.isSign()) refuse("Write powers of ten without spaces: 3e-2.");
        const work = over ? divide : multiply;
        left = (at) => work(before(at), right(at));
      }
    }
    isSign() { return ["+", "-"].includes(this.token.kind); }
    signed() {
      const sign = this.take("-", "+");
      if (!sign) return this.raised();
      if (this.isSign()) refuse("There are two signs before a number.");
      const value = this.raised();
      return sign.kind === "-" ? (at) => subtract(whole(0), value(at)) : value;
    }
    raised() {
      let base = this.atom();
      const high = this.take("raised");
      if (high) {
        const digits = [...high.value].map((sign) => RAISED[sign]).join("");
        if (!/^-?[0-9]{1,3}$/.test(digits)) refuse("The exponent is not understood.");
        const [before, exponent] = [base, whole(digits)];
        base = (at) => power(before(at), exponent);
      } else if (this.take("^")) {
        const bracketed = this.token.kind === "(";
        const minus = this.take("-");
        const [before, exponent] = [base, this.atom()];
        base = (at) => power(before(at), minus ? subtract(whole(0), exponent(at)) : exponent(at));
        const third = this.token.kind === "/" && this.tokens[this.next - 1].value === "1";
        if (!bracketed && (third || ["^", "name", "("].includes(this.token.kind))) refuse("Put brackets around the exponent.");
      }
      this.percent = false;
      while (this.take("%")) {
        this.decimal = this.percent = true;
        const before = base;
        base = (at) => divide(before(at), whole(100));
        if (!["end", ")", "+", "-", "*"].includes(this.token.kind)) refuse("The percent sign is not expected there.");
      }
      return base;
    }
    atom() {
      const token = this.tokens[this.next++] ?? refuse("Something is missing at the end.");
      switch (token.kind) {
        case "number": {
          if (!/^[0-9]+$/.test(token.value)) {
            this.decimal = true;
            if (this.token.kind === "(") refuse("Write digits that repeat as a fraction.");
          }
          const value = decimalValue(token.value, this.longest);
          return () => value;
        }
        case "vulgar": {
          const value = fraction(VULGAR[token.value]);
          return () => value;
        }
        case "mixed": {
          if (!["end", "+", "-", ")"].includes(this.token.kind)) refuse("Put brackets around the mixed number.");
          const before = this.tokens[this.next - 2]?.kind;
          if (!["+", "-", "(", undefined].includes(before)) refuse("Put brackets around the mixed number.");
          const [, digits, rest] = /^([0-9]+)\s*(.*)$/u.exec(token.value);
          const below = fraction(VULGAR[rest] ?? rest);
          if (below[0] >= below[1]) refuse("After a whole number the fraction must be below one, as in 1 3/4; write a sign between.");
          const value = add(whole(digits), below);
          return () => value;
        }
        case "(": {
          const inside = this.sum();
          if (!this.take(")")) refuse("A bracket is not closed.");
          return inside;
        }
        case "√": {
          const inside = this.atom();
          return (at) => root(inside(at));
        }
        case "name":
          return this.named(token.value);
        default:
          return refuse("“{}” is not expected there.", token.value);
      }
    }
    named(typed) {
      const name = this.parameters.includes(typed) ? typed : GREEK[typed] ?? typed.toLowerCase();
      if (this.parameters.includes(name)) return (at) => at(name);
      if (name === "e" && this.parameters.includes("epsilon")) refuse("“e” may be ε or the number e; write epsilon, or exp(1).");
      if (name === "e") return () => Math.E;
      if (name === "pi") return () => Math.PI;
      if (!(name in FUNCTIONS)) {
        return this.parameters.length
          ? refuse("“{}” is not something this answer may contain; write numbers and {}.", typed, this.parameters.join(", "))
          : refuse("“{}” is not something this answer may contain; write the number alone.", typed);
      }
      if (this.token.kind !== "(") refuse("Put brackets behind {}.", name);
      const inside = this.atom();
      return (at) => {
        const value = inside(at);
        if (value instanceof Ratio) throw new NoRatio();
        return FUNCTIONS[name](value);
      };
    }
  }

  // A number, perhaps in several forms, with a name before it: V(s) = 1/4 = 0.25
  function read(typed, parameters = [], comma = false) {
    if (typed.length > 400) refuse("It is too long.");
    const text = spelled(typed).replace(/^[≈~]\s*/u, "").replace(/≈\s*([-+]?[0-9]+)$/u, "≈ $1.");
    if (!text) refuse("Nothing was typed.");
    if (/(?<![0-9.,])0[·⋅∙][0-9]/u.test(typed)) refuse("A raised point may be a decimal point, or a sign for times; write another one.");
    const forms = text.split(/[=≈:]/u).map((form) => form.trim());
    const one = (form) => {
      const said = comma ? pointed(form) : form;
      const parser = new Parser(said, parameters, 40);
      const value = parser.all();
      POINTS.slice(0, parameters.length ? 2 : 1).forEach((_, number) => float(value(pointOf(number))));
      return { value, decimal: parser.decimal, said };
    };
    if (forms.length > 1 && (!forms[0] || (isWord(forms[0]) && !ifRead(() => one(forms[0]))))) forms.shift();
    forms.forEach(refuseTwice);
    const readings = forms.map(one);
    if (forms.length > 1 && NAME.test(forms[0]) && !agree(readings)) readings.shift(); // e = 2 may name the trace
    return agree(readings) ? readings[0] : refuse("It says two numbers which differ; write one.");

    // Behind a space, in brackets: a factor, or the same again?
    function refuseTwice(form) {
      const [, before, inside] = /^(.*\S)\s+\((.*)\)$/su.exec(form) ?? [];
      const both = before && ifRead(() => [before, inside].map(one));
      if (both && (/^[-+0-9.,/%\s]+$/u.test(inside) || agree(both) || agree([...both].reverse()))) {
        refuse("What stands in brackets may be a factor, or the same number again; write one number.");
      }
    }
    function agree([first, ...others]) {
      const [here, value] = [pointOf(0), first.value];
      return others.every((other) => (varies(value) || varies(other.value) ? equivalent(value, other.value)
        : Math.abs(float(value(here)) - float(other.value(here))) <= (other.decimal ? lastDigit(other.said) / 2 : 0) + 1e-9));
    }
  }
  const isWord = (form) => /^[^\W\d]|^[α-ωΑ-Ω∂]/u.test(form) && !Object.hasOwn(FUNCTIONS, /^[a-z]*/iu.exec(form)[0].toLowerCase());
  const NAME = /^\p{L}[\p{L}\p{N}_' ]*(?:\([^()]*\)|\[[^[\]]*\])?$/u;
  // The unit of the last digit of a decimal, to which another form of it may be rounded; 0 where there is more than that
  const lastDigit = (said) => {
    const found = /^[-+]?\s*(?:[0-9]+(?:\.([0-9]*))?|\.([0-9]+))(?:e([-+]?[0-9]+))?\s*(%)?$/iu.exec(said);
    if (!found) return 0;
    const [, behind, alone, exponent, percent] = found;
    return 10 ** (Number(exponent ?? 0) - (behind ?? alone ?? "").length - (percent ? 2 : 0));
  };
  // What a work gives; nothing where something in it cannot be read or has no value
  const ifRead = (work) => {
    try {
      return work();
    } catch (error) {
      if (!(error instanceof Unreadable)) throw error;
      return null;
    }
  };

  // The rule
  const POINTS = [0.3819660113, 0.1415926536, 0.7182818285, 0.5772156649, 0.9159655942, 0.2502907875, 0.6434105463, 0.8346268417];
  const SHARES = ["gamma", "alpha", "lambda", "epsilon", "p", "q"];
  // Every letter has a point of its own, within its range
  const pointOf = (number) => (name) => {
    const share = POINTS[(number + [...name].reduce((total, sign) => total + sign.charCodeAt(0), 0)) % POINTS.length];
    return SHARES.includes(name) ? share : share / (1 - share);
  };
  const tolerance = ([n, d]) => {
    if (n === 0n) return [1n, 2000n];
    let exponent = abs(n).toString().length - d.toString().length;
    const reaches = (e) => (e >= 0 ? abs(n) >= d * 10n ** BigInt(e) : abs(n) * 10n ** BigInt(-e) >= d);
    if (!reaches(exponent)) exponent -= 1;
    const last = exponent - 2;
    return last >= 0 ? quotient(10n ** BigInt(last), 2n) : quotient(1n, 2n * 10n ** BigInt(-last));
  };
  const roughTolerance = (key) => (key === 0 ? 0.0005 : 10 ** (Math.floor(Math.log10(Math.abs(key))) - 2) / 2);
  const near = (value, key) => {
    if (isExact(value) && isExact(key)) {
      const [n, d] = subtract(value, key), [tn, td] = tolerance(key);
      return abs(n) * td <= tn * d;
    }
    const [a, b] = [float(value), float(key)];
    return Math.abs(a - b) <= roughTolerance(b) * (1 + 1e-12);
  };
  const sampled = (test) => POINTS.every((_, number) => test(pointOf(number)));
  const equivalent = (value, key) => sampled((point) => {
    const [a, b] = [float(value(point)), float(key(point))];
    return Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(a), Math.abs(b));
  });

  function right(reading, keyText, parameters = []) {
    const key = new Parser(keyText, parameters).all();
    const open = parameters.some((name) => new RegExp(`(?<![A-Za-z])${name}(?![A-Za-z])`).test(keyText)) || varies(reading.value);
    if (!open) return near(reading.value(pointOf(0)), key(pointOf(0)));
    return equivalent(reading.value, key) || (reading.decimal && isRounded(reading.value, key));
  }
  // In lowest terms, where one letter is in it and all numbers are exact: without what Euclid finds above and below
  function reduced(ratio) {
    const terms = [...ratio.top, ...ratio.bottom];
    const letters = new Set(terms.flatMap(([each]) => each.split(" ").filter(Boolean)));
    if (letters.size !== 1 || !terms.every(([, number]) => isExact(number))) return ratio;
    const [letter] = letters;
    const product = (power) => Array(power).fill(letter).join(" ");
    const listed = (poly) => {
      const degree = Math.max(-1, ...[...poly.keys()].map((each) => each.split(" ").filter(Boolean).length));
      return Array.from({ length: degree + 1 }, (_, power) => poly.get(product(power)) ?? whole(0));
    };
    const trimmed = (poly) => { while (poly.length && isZero(poly.at(-1))) poly.pop(); return poly; };
    const dividedBy = (poly, other) => {
      const [rest, found] = [[...poly], []];
      while (rest.length >= other.length) {
        const [factor, shift] = [divide(rest.at(-1), other.at(-1)), rest.length - other.length];
        found[shift] = factor;
        other.forEach((number, power) => { rest[power + shift] = subtract(rest[power + shift], multiply(factor, number)); });
        rest.pop();
      }
      return [Array.from(found, (number) => number ?? whole(0)), trimmed(rest)];
    };
    let [common, other] = [listed(ratio.top), listed(ratio.bottom)];
    while (other.length) [common, other] = [other, dividedBy(common, other)[1]];
    const part = (poly) => new Map(dividedBy(listed(poly), common)[0].flatMap((number, power) => (isZero(number) ? [] : [[product(power), number]])));
    return common.length > 1 ? new Ratio(part(ratio.top), part(ratio.bottom)) : ratio;
  }
  // Each number of an expression is right to three digits, whichever of those below the line is taken to be as it is
  function isRounded(value, key) {
    let ours, theirs;
    try {
      [ours, theirs] = [value, key].map((each) => reduced(Ratio.of(each(Ratio.letter))));
    } catch (error) {
      if (error instanceof Unreadable) return false;
      if (!(error instanceof NoRatio)) throw error;
      return sampled((point) => near(value(point), key(point)));
    }
    const alike = (one, other) => one.size === other.size && [...one.keys()].every((letters) => other.has(letters));
    if (!alike(ours.top, theirs.top) || !alike(ours.bottom, theirs.bottom)) return false;
    return [...theirs.bottom.keys()].some((letters) => ["top", "bottom"].every((part) => [...theirs[part]].every(([place, number]) =>
      near(divide(ours[part].get(place), ours.bottom.get(letters)), divide(number, theirs.bottom.get(letters))))));
  }
  const varies = (value) => { const [a, b] = [0, 1].map((number) => float(value(pointOf(number)))); return a !== b; };
  const closeTo = (reading, keyText, parameters) => {
    const key = new Parser(keyText, parameters).all();
    if (parameters.length && (varies(reading.value) || varies(key))) return false;
    const [a, b] = [reading.value(pointOf(0)), key(pointOf(0))];
    if (!reading.decimal && !Number.isInteger(float(a))) return false; // who writes 5/16 or 2√3 means just that
    if (isZero(b)) return false;
    const off = subtract(divide(a, b), whole(1)); // exactly, where both are: 0.17 is 2 % off 1/6
    return isExact(off) ? abs(off[0]) * 50n <= off[1] : Math.abs(off) <= 1 / 50;
  };
  // Whether a number is the key, rounded or cut off where its own digits end, which are fewer than three
  const isShort = (reading, keyText, parameters) => {
    const [a, b] = [reading.value, new Parser(keyText, parameters).all()].map((value) => value(pointOf(0)));
    if (!isExact(a)) return false;
    let places = 0;
    while (places < 10 && (10n ** BigInt(places) * a[0]) % a[1] !== 0n) places += 1;
    const scale = 10n ** BigInt(places);
    if ((scale * a[0]) % a[1] !== 0n || abs(a[0]) * scale >= 100n * a[1]) return false;
    const gap = subtract(a, b);
    return isExact(gap) ? abs(gap[0]) * scale < gap[1] : Math.abs(gap) * Number(scale) < 1;
  };

  const TOLD = {
    right: "Right.", short: "Right idea; give an exact value or three digits.", wrong: "Not right.",
    close: "Close, but not right: look for a slip, or for numbers that were rounded on the way.",
    some: "Not right at {}; the rest is right.", choose: "Choose an answer.", comma: false,
  };

  // One part: what was typed for each of its cells, and what is known of it, in words that may be others than ours.
  function part(task, typed, others = {}) {
    const told = { ...TOLD, ...others };
    const readings = [], wrong = [];
    const fits = (index, key) => (Array.isArray(key) ? key.includes(readings[index]) : right(readings[index], key, task.parameters));
    for (const [index, cell] of task.cells.entries()) {
      if (cell.words) {
        if (!typed[index]) return { outcome: "unreadable", says: told.choose, cell: index };
        readings.push(typed[index]);
        if (!fits(index, cell.words)) wrong.push(index);
        continue;
      }
      try {
        readings.push(read(typed[index] ?? "", task.parameters, told.comma));
        if (!fits(index, cell.key)) wrong.push(index);
      } catch (error) {
        if (!(error instanceof Unreadable)) throw error;
        return { outcome: "unreadable", says: (cell.name ? `${cell.name}: ` : "") + error.says(told), cell: index };
      }
    }
    if (!wrong.length) return { outcome: "right", says: told.right };
    const made = task.mistakes.find((mistake) => ifRead(() => mistake.cells.every((key, index) => fits(index, key))));
    if (made) return { outcome: "misconception", says: made.says, read: made.read, wrong };
    if (wrong.every((index) => !task.cells[index].words && closeTo(readings[index], task.cells[index].key, task.parameters))) {
      const short = wrong.every((index) => isShort(readings[index], task.cells[index].key, task.parameters));
      return { outcome: "close", says: short ? told.short : told.close, wrong };
    }
    const names = wrong.map((index) => task.cells[index].name).filter(Boolean);
    const some = names.length && names.length < task.cells.length;
    return { outcome: "wrong", says: some ? told.some.replace("{}", names.join("; ")) : told.wrong, wrong };
  }

  // A whole answer pasted into one of the boxes with these names: [box, text] for each of its entries, by name where all
  // have one, else from that box on; nothing where it is one entry, or it is not clear whose they are.
  function pasted(text, names, at, comma = false) {
    const found = entries(text, comma, false);
    if (found.length < 2 || (!comma && /^\s*[-+−]?[0-9]+,[0-9]+\s*$/u.test(text))) return null; // 0,5 may be one number
    const called = found.map((entry) => /^([^=:]*)[=:](.*)$/su.exec(entry) ?? ["", "", entry]);
    const places = called.map(([, name]) => placeOf(name, names));
    if (places.every((place) => place < 0)) {
      return found.length > names.length - at ? null : found.map((entry, index) => [at + index, entry]);
    }
    if (places.includes(-1) || new Set(places).size < places.length) return null;
    return places.map((place, index) => [place, called[index][2].trim()]);
  }
  // V(cool), "cool" and (cool) name the box that is called cool
  const placeOf = (typed, names) => {
    const bare = (name) => name.normalize("NFKC").toLowerCase().replace(/[\s"']/gu, "").replace(/^\((.*)\)$/u, "$1");
    const called = bare(typed), of = /\(([^()]*)\)$/u.exec(called)?.[1];
    return names.findIndex((name) => name && [called, of].includes(bare(name)));
  };
  // The entries of a list, of its rows, and of lists in it; blanks part them within square brackets alone
  function entries(text, comma, square) {
    const list = text.trim(), within = inside(list);
    if (within !== null) {
      const found = entries(within, comma, square || list[0] === "[");
      return found.length > 1 || list[0] === "[" ? found : [list];
    }
    const pieces = parted(list, comma);
    if (pieces.length > 1) return pieces.flatMap((piece) => entries(piece, comma, square));
    const words = list.split(/\s+/u);
    return square && !words.some((word) => /^[*/^=:]|[-+−*/^=:]$/u.test(word)) ? words : [list];
  }
  const deeper = (sign) => "([{".includes(sign) - ")]}".includes(sign);
  // What stands between brackets that hold all of a text
  const inside = (text) => {
    let depth = 0;
    const end = [...text].findIndex((sign) => { depth += deeper(sign); return !depth; });
    return end > 0 && end === [...text].length - 1 ? text.slice(1, -1) : null;
  };
  const parted = (text, comma) => {
    const pieces = [""];
    let depth = 0;
    [...text].forEach((sign, index, all) => {
      depth += deeper(sign);
      const parts = ";\n\t".includes(sign) || (sign === "," && (!comma || /\s/u.test(all[index + 1] ?? " ")));
      if (parts && !depth) pieces.push("");
      else pieces.push(pieces.pop() + sign);
    });
    return pieces.map((piece) => piece.trim()).filter(Boolean);
  };

  return { part, pasted, read, right, Unreadable };
})();
