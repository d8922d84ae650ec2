"use strict";
// Shows the families that are searched for.
(() => {
  const box = document.getElementById("search");
  const cards = [...document.querySelectorAll("[data-text]")];
  const find = Search.index(cards.map((card) => card.dataset.text));
  const search = () => {
    const { searched, instead, found } = find(box.value);
    cards.forEach((card, index) => { card.hidden = !found[index]; });
    for (const section of document.querySelectorAll("section")) section.hidden = !section.querySelector("li:not([hidden])");
    const told = instead.length ? ` (${instead.join(", ")})` : "";
    document.getElementById("found").textContent = searched ? `${found.filter(Boolean).length} of ${cards.length}${told}` : "";
  };
  box.addEventListener("input", search);
  search();
})();
