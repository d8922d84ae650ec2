"use strict";
// What the page does: each part is a form, judged where it stands; nothing leaves the page.
(() => {
  const data = JSON.parse(document.getElementById("tasks").textContent);
  const done = new Set();
  const marks = { right: "✓", close: "≈", unreadable: "?", misconception: "✗", wrong: "✗" };
  const typed = (form, task) => task.cells.map((_, index) => {
    const fields = form.elements[`cell-${index}`];
    return fields instanceof RadioNodeList ? fields.value : fields.type === "radio" ? (fields.checked ? fields.value : "") : fields.value;
  });
  for (const form of document.querySelectorAll("form.part")) {
    const task = data.tasks[form.id];
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const verdict = Judge.part(task, typed(form, task), data.told);
      const said = form.querySelector("output");
      said.textContent = `${marks[verdict.outcome]} ${verdict.says}`;
      said.className = verdict.outcome;
      said.insertAdjacentHTML("beforeend", verdict.read ?? "");
      if (verdict.outcome === "unreadable") form.elements[`cell-${verdict.cell}`]?.focus?.();
      form.querySelectorAll("[data-cell]").forEach((field) => {
        const wrong = (verdict.wrong ?? []).includes(Number(field.dataset.cell));
        field.setAttribute("aria-invalid", wrong ? "true" : "false");
      });
      done[verdict.outcome === "right" ? "add" : "delete"](form.id);
      document.getElementById("score").textContent = data.score.replace("{}", done.size).replace("{}", Object.keys(data.tasks).length);
    });
    // A whole answer pasted into one box fills the others, too.
    form.addEventListener("paste", (event) => {
      const boxes = [...form.querySelectorAll("input[data-cell]")];
      const names = boxes.map((box) => task.cells[box.dataset.cell].name);
      const at = boxes.indexOf(event.target);
      const found = at >= 0 && Judge.pasted(event.clipboardData?.getData("text") ?? "", names, at, data.told.comma);
      if (!found) return;
      event.preventDefault();
      found.forEach(([index, text]) => { boxes[index].value = text; });
    });
  }
})();
