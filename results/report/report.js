// Tables that sort by a click on a heading and that a field filters. Without this script all rows are shown, in the
// order of the measurements.
for (const element of document.querySelectorAll('.scripted')) element.hidden = false;

const units = { ns: 1e-9, µs: 1e-6, ms: 1e-3, kB: 1e3, MB: 1e6, GB: 1e9 };
// The number that a text begins with, in the unit that follows it; NaN: none.
const numberIn = (text) => {
  const found = text.match(/^[≈<>≤≥~ ]*([-−]?\d[\d,]*(?:\.\d+)?(?:e[-+]?\d+)?)\s*([nµm]s|[kMG]B)?(?![-\d\/.]| (?:m|b)illion)/);
  return found ? Number(found[1].replaceAll(',', '').replace('−', '-')) * (units[found[2]] ?? 1) : NaN;
};
const words = new Intl.Collator(undefined, { numeric: true });
const isEmpty = (text) => text === '' || text === '–';

// A comparison of texts: numbers if all of them are some, else words.
const comparison = (texts) =>
  texts.every((text) => isEmpty(text) || !Number.isNaN(numberIn(text)))
    ? (a, b) => numberIn(a) - numberIn(b)
    : words.compare;

// Rising, falling, then the first order again. Cells without a value come last.
const sortBy = (heading, body, inOrder) => {
  const next = { none: 'ascending', ascending: 'descending' }[heading.getAttribute('aria-sort') ?? 'none'];
  for (const other of heading.parentElement.cells) other.removeAttribute('aria-sort');
  if (!next) return body.append(...inOrder);
  heading.setAttribute('aria-sort', next);
  const rows = inOrder.map((row) => [row.cells[heading.cellIndex].textContent.trim(), row]);
  const compare = comparison(rows.map(([text]) => text));
  const sign = next === 'ascending' ? 1 : -1;
  rows.sort(([a], [b]) => isEmpty(a) - isEmpty(b) || (isEmpty(a) ? 0 : sign * compare(a, b)));
  body.append(...rows.map(([, row]) => row));
};

for (const table of document.querySelectorAll('table')) {
  const body = table.tBodies[0];
  const inOrder = [...body.rows];
  if (inOrder.length < 3) continue;
  for (const heading of table.tHead.rows[0].cells) {
    const button = document.createElement('button');
    button.append(...heading.childNodes);
    button.addEventListener('click', () => sortBy(heading, body, inOrder));
    heading.append(button);
  }
}

// `?filter=…` fills the field of the table that searches are for, and leads to it.
for (const part of document.querySelectorAll('.filter')) {
  const rows = [...document.getElementById(part.dataset.table).tBodies[0].rows];
  const texts = rows.map((row) => [...row.cells].map((cell) => cell.textContent).join(' ').toLowerCase());
  const field = part.querySelector('input');
  const apply = () => {
    const wanted = field.value.toLowerCase().split(/\s+/);
    let shown = 0;
    rows.forEach((row, i) => {
      row.hidden = !wanted.every((word) => texts[i].includes(word));
      shown += row.hidden ? 0 : 1;
    });
    part.querySelector('output').textContent = `${shown} of ${rows.length} rows`;
  };
  field.addEventListener('input', apply);
  const asked = 'search' in part.dataset ? new URLSearchParams(location.search).get('filter') : null;
  if (asked) {
    field.value = asked;
    part.scrollIntoView();
  }
  apply();
}

// Pictures of several panels: two of them over each other, with a slider between them.
const panelsOver = (file, panels) => {
  const [pair, slider] = [document.createElement('div'), document.createElement('input')];
  pair.className = 'pair';
  Object.assign(slider, { type: 'range', min: 0, max: 100, value: 50, ariaLabel: 'Where the right panel begins, in %' });
  slider.addEventListener('input', () => pair.style.setProperty('--at', `${slider.value}%`));
  const choices = ['Left', 'Right'].map((side, k) => {
    pair.insertAdjacentHTML('beforeend', '<svg role="img"><image></image></svg>');
    const view = pair.lastElementChild;
    view.firstChild.setAttribute('href', file);
    const [label, select] = [document.createElement('label'), document.createElement('select')];
    panels.forEach(([, name], i) => select.add(new Option(name, i, i === k, i === k)));
    const show = () => {
      view.setAttribute('viewBox', panels[select.value][0]);
      view.setAttribute('aria-label', panels[select.value][1]);
    };
    select.addEventListener('change', show);
    show();
    label.append(`${side}: `, select);
    return label;
  });
  return [...choices, pair, slider];
};

for (const figure of document.querySelectorAll('[data-panels]')) {
  const [details, summary] = [document.createElement('details'), document.createElement('summary')];
  const panels = figure.dataset.panels.split('\n').map((line) => line.match(/^(\d+ \d+ \d+ \d+) (.*)$/).slice(1));
  summary.textContent = 'Compare two panels with a slider';
  details.append(summary);
  details.addEventListener('toggle', () => details.append(...panelsOver(figure.querySelector('img').src, panels)),
    { once: true });
  details.className = 'compare';
  figure.append(details);
}

// A plot shows its values under the pointer if it is an object. As images they load later and print better, so that only
// those are changed that come into view.
const toObject = (link) => {
  const [image, object] = [link.querySelector('img'), document.createElement('object')];
  Object.assign(object, { type: 'image/svg+xml', data: image.src, className: 'loading', role: 'img', ariaLabel: image.alt });
  object.addEventListener('load', () => {
    object.className = '';
    link.remove();
  });
  link.after(object);
};
const seen = new IntersectionObserver((entries) => {
  for (const entry of entries.filter((each) => each.isIntersecting)) {
    seen.unobserve(entry.target);
    toObject(entry.target);
  }
});
for (const link of document.querySelectorAll('.plot a')) seen.observe(link);
