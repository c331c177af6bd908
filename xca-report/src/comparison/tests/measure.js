// Stands at the end of a copy of the page, in a frame as wide as a window: tells the page around it what a reader would see, once it is
// laid out.
"use strict";
const loads = [];
addEventListener("securitypolicyviolation", (event) => loads.push(`${event.violatedDirective} ${event.blockedURI}`));

const seen = (element) => element.getClientRects().length > 0;
const all = (selector, within = document) => [...within.querySelectorAll(selector)].filter(seen);
const box = (element) => element.getBoundingClientRect();
const inside = (inner, outer) =>
  inner.left >= outer.left - 1 && inner.right <= outer.right + 1 && inner.top >= outer.top - 1 && inner.bottom <= outer.bottom + 1;
const overlap = (one, other) =>
  Math.min(one.right, other.right) - Math.max(one.left, other.left) > 1 &&
  Math.min(one.bottom, other.bottom) - Math.max(one.top, other.top) > 1;
const page = () => ({ left: 0, top: 0, right: innerWidth, bottom: document.documentElement.scrollHeight });

function plot(svg) {
  const texts = [...svg.querySelectorAll("text")].map((text) => ({ text: text.textContent.trim(), box: box(text), element: text }));
  const faults = [];
  for (const [index, { text, box: place }] of texts.entries()) {
    if (!inside(place, box(svg))) faults.push(`"${text}" leaves the plot`);
    for (const other of texts.slice(index + 1)) {
      if (overlap(place, other.box)) faults.push(`"${text}" and "${other.text}" overlap`);
    }
  }
  if (!inside(box(svg), page())) faults.push("it leaves the page");
  const sizes = texts.map(({ element }) => parseFloat(getComputedStyle(element).fontSize) * svg.getScreenCTM().a);
  return { width: box(svg).width, height: box(svg).height, least_text: Math.min(...sizes), texts: texts.length, faults };
}

// A table may be wider than the page where it can be moved.
function table(element) {
  const faults = [];
  const around = element.parentElement;
  const moves = ["auto", "scroll"].includes(getComputedStyle(around).overflowX);
  if (element.offsetWidth > around.clientWidth + 1 && !moves) faults.push("its end cannot be reached");
  for (const cell of all("th, td", element)) {
    if (cell.scrollWidth > cell.clientWidth + 1) faults.push(`"${cell.textContent}" is cut off`);
    const text = document.createRange();
    text.selectNodeContents(cell);
    if (cell.className === "number" && box(text).height > 30) faults.push(`"${cell.textContent}" is broken into lines`);
  }
  const first = all("tr > :first-child", element);
  around.scrollLeft = around.scrollWidth;
  if (first.some((cell) => box(cell).left < box(around).left - 1)) faults.push("the first column does not stay");
  around.scrollLeft = 0;
  return { rows: all("tbody tr", element).length, hidden: Math.max(0, element.offsetWidth - around.clientWidth), faults };
}

function texts() {
  const faults = [];
  for (const element of all("h1, h2, p, li, dt, dd, figcaption, .verdict")) {
    const name = `${element.localName} "${element.textContent.trim().slice(0, 40)}"`;
    if (!inside(box(element), page())) faults.push(`${name} leaves the page`);
    if (element.localName !== "li" && getComputedStyle(element).display !== "inline" && element.scrollWidth > element.clientWidth + 1) {
      faults.push(`${name} is cut off`);
    }
    if (parseFloat(getComputedStyle(element).fontSize) < 12) faults.push(`${name} is too small to read`);
  }
  return faults;
}

addEventListener("load", () => {
  const found = {
    page: innerWidth,
    content: document.documentElement.scrollWidth,
    loads: loads.concat(performance.getEntriesByType("resource").map((entry) => entry.name)),
    verdicts: all("#verdicts .verdict").map((badge) => ({
      text: badge.innerText,
      background: getComputedStyle(badge).backgroundColor,
      colour: getComputedStyle(badge).color,
    })),
    headings: all("h2").map((heading) => heading.innerText),
    plots: all("svg").map(plot),
    legend: all(".legend li").map((entry) => [entry.innerText, getComputedStyle(entry.firstElementChild).backgroundColor]),
    tables: all("table").map(table),
    faults: texts(),
  };
  parent.postMessage(found, "*");
});
