"use strict";
// Which texts hold all words that are typed; a word that stands in none is taken for those that are spelled almost alike.

const Search = (() => {
  const plain = (text) => text.toLowerCase().normalize("NFD").replace(/[\u0300-\u036f-]/g, "");
  const wordsOf = (text) => text.split(/[^\p{L}\p{N}]+/u).filter(Boolean);

  // How many letters are left out, put in, exchanged for another or with their neighbour; infinite where it is over the bound.
  function apart(one, other, bound) {
    if (Math.abs(one.length - other.length) > bound) return Infinity;
    let [before, last] = [[], [...Array(other.length + 1).keys()]];
    for (let i = 1; i <= one.length; i += 1) {
      const line = [i];
      for (let j = 1; j <= other.length; j += 1) {
        line[j] = Math.min(last[j] + 1, line[j - 1] + 1, last[j - 1] + (one[i - 1] === other[j - 1] ? 0 : 1));
        if (one[i - 1] === other[j - 2] && one[i - 2] === other[j - 1]) line[j] = Math.min(line[j], before[j - 2] + 1);
      }
      [before, last] = [last, line];
    }
    return last[other.length];
  }

  function index(texts) {
    const plains = texts.map(plain);
    const known = new Set(plains.flatMap(wordsOf));
    const nearest = (word) => {
      const bound = word.length < 4 ? 0 : word.length < 8 ? 1 : 2;
      const near = [...known].map((other) => [apart(word, other, bound), other]).filter(([distance]) => distance <= bound);
      const least = Math.min(...near.map(([distance]) => distance));
      return near.filter(([distance]) => distance === least).map(([, other]) => other);
    };
    // For each text whether it is found, and what was searched for instead of words that stand nowhere.
    return (typed) => {
      const instead = [];
      const wanted = plain(typed).split(/\s+/).filter(Boolean).map((word) => {
        if (plains.some((text) => text.includes(word))) return [word];
        const near = nearest(word);
        instead.push(...near);
        return near;
      });
      return { searched: wanted.length > 0, instead, found: plains.map((text) => wanted.every((any) => any.some((word) => text.includes(word)))) };
    };
  }

  return { index };
})();
