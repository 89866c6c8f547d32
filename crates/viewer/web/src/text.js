// Numbers as people read them, and elements of the page.

/** Six digits, as many as single precision holds for certain. */
export function number(x) {
  if (x === null || x === undefined) return 'unknown';
  if (x === 0) return '0';
  const size = Math.abs(x);
  return size >= 1e6 || size < 1e-4 ? x.toExponential(5) : String(Number(x.toPrecision(6)));
}

/** Three digits: for axes and legends. */
export function short(x) {
  if (x === 0) return '0';
  const size = Math.abs(x);
  return size >= 1e5 || size < 1e-3 ? x.toExponential(1).replace('.0e', 'e') : String(Number(x.toPrecision(3)));
}

/** A share as a percentage. */
export function percent(share) {
  if (share === null || share === undefined) return 'unknown';
  return `${short(100 * share)} %`;
}

/** Seconds, as long as they matter. */
export function seconds(s) {
  return s < 1 ? `${short(1000 * s)} ms` : `${short(s)} s`;
}

/** A count with thousands set apart. */
export function count(n) {
  return Math.round(n).toLocaleString('en');
}

/** An element with attributes and children; text is never read as markup. */
export function make(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/** The same for drawings. */
export function draw(tag, attributes = {}, ...children) {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/** A table with a head. Cells that are numbers are set to the right. */
export function table(head, rows) {
  const cell = (tag) => (content, column) => {
    const node = content instanceof Node ? content : document.createTextNode(String(content));
    return make(tag, column > 0 && rows.numeric ? { class: 'number' } : {}, node);
  };
  const body = rows.map((row) => make('tr', {}, ...row.map(cell('td'))));
  return make('div', { class: 'scroll' },
    make('table', {},
      make('thead', {}, make('tr', {}, ...head.map(cell('th')))),
      make('tbody', {}, ...body)));
}

/** Rows of numbers. */
export function numeric(rows) {
  return Object.assign(rows, { numeric: true });
}

/** Names and what they are. */
export function facts(rows) {
  return make('dl', {}, ...rows.filter(([, value]) => value !== null && value !== undefined)
    .flatMap(([name, value]) => [make('dt', {}, name), make('dd', {}, value)]));
}
