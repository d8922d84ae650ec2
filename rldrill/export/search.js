"use strict";
// Shows the families in whose texts all words occur that are typed.
(() => {
  const box = document.getElementById("search");
  const cards = [...document.querySelectorAll("[data-text]")];
  const plain = (text) => text.toLowerCase().normalize("NFD").replace(/[\u0300-\u036f-]/g, "");
  const search = () => {
    const words = plain(box.value).split(/\s+/).filter(Boolean);
    let found = 0;
    for (const card of cards) {
      const text = plain(card.dataset.text);
      card.hidden = !words.every((word) => text.includes(word));
      found += card.hidden ? 0 : 1;
    }
    for (const section of document.querySelectorAll("section")) section.hidden = !section.querySelector("li:not([hidden])");
    document.getElementById("found").textContent = words.length ? `${found} of ${cards.length}` : "";
  };
  box.addEventListener("input", search);
  search();
})();
