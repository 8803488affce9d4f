"use strict";
const rows = [...document.querySelectorAll("tbody tr")];
const outcome = document.getElementById("outcome");
const search = document.getElementById("name");
const texts = rows.map((row) => row.querySelector("th").textContent.toLowerCase());
function choose() {
  const wanted = search.value.trim().toLowerCase();
  let count = 0;
  rows.forEach((row, i) => {
    const fits = (!outcome.value || row.querySelector("td." + outcome.value)) && texts[i].includes(wanted);
    row.hidden = !fits;
    count += fits ? 1 : 0;
  });
  document.getElementById("count").textContent = `${count} of ${rows.length} curves`;
}
outcome.addEventListener("change", choose);
search.addEventListener("input", choose);
choose();
