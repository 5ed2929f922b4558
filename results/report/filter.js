// Hides the rows of a table that lack a word of the field before it; `?filter=…` fills the field.
for (const part of document.querySelectorAll('.filter')) {
  const rows = [...document.getElementById(part.dataset.table).tBodies[0].rows];
  const texts = rows.map((row) => [...row.cells].map((cell) => cell.textContent).join(' ').toLowerCase());
  const field = part.querySelector('input');
  const apply = () => {
    const words = field.value.toLowerCase().split(/\s+/);
    let shown = 0;
    rows.forEach((row, i) => {
      row.hidden = !words.every((word) => texts[i].includes(word));
      shown += row.hidden ? 0 : 1;
    });
    part.querySelector('output').textContent = `${shown} of ${rows.length} rows`;
  };
  field.value = new URLSearchParams(location.search).get('filter') ?? '';
  field.addEventListener('input', apply);
  part.hidden = false;
  apply();
}
