#!/usr/bin/env python3
"""Usage: site_test.py PROGRAM RESULTS FOLDER [PICTURES]

Writes the report of a copy of RESULTS in FOLDER and reads it as a visitor does, with headless Chromium: in windows of three
widths, light and dark, without scripts. Exits with 77 (skipped) where Chromium is not installed. PICTURES: a folder for
screenshots of what was opened.
"""
import base64
import html
import re
import shutil
import subprocess
import sys
import urllib.parse
from pathlib import Path

sys.dont_write_bytecode = True  # none in the source tree
from browser import Browser  # noqa: E402

PROGRAM, RESULTS, FOLDER = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]).resolve()
PICTURES = Path(sys.argv[4]).resolve() if len(sys.argv) > 4 else None
WIDTHS = (360, 800, 1400)
PAGES = ("index.html", "paper-hybrid.html", "paper-cross.html", "ground-jacksboro.html", "ledger.html",
         "wrong-or-vague.html", "findings.html", "runs.html")
MOST_BYTES = 300_000
failures = []

# What a reader could not read: text beside its box or the window, unless the box scrolls; text whose contrast is below the
# AA of WCAG 2.
UNREADABLE = """(() => {
  const found = [], channel = (c) => (c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  const rgba = (text) => text.match(/[\\d.]+/g).map(Number);
  const light = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
  const behind = (e) => {
    for (; e; e = e.parentElement) {
      const colour = rgba(getComputedStyle(e).backgroundColor);
      if ((colour[3] ?? 1) > 0) return colour;
    }
    return [255, 255, 255];
  };
  const scrolls = (e) => e && (getComputedStyle(e).overflowX !== 'visible' || scrolls(e.parentElement));
  const page = document.scrollingElement;
  if (page.scrollWidth > innerWidth) found.push(`the page is ${page.scrollWidth} wide in ${innerWidth}`);
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const range = document.createRange();
  while (texts.nextNode()) {
    const node = texts.currentNode, element = node.parentElement;
    if (!node.data.trim() || !element.checkVisibility() || element.closest('script')) continue;
    const style = getComputedStyle(element), say = (what) => found.push(`${what}: ${node.data.trim().slice(0, 60)}`);
    const [a, b] = [light(rgba(style.color)), light(behind(element))].sort((x, y) => y - x);
    const size = parseFloat(style.fontSize), large = size >= 24 || (size >= 18.6 && style.fontWeight >= 700);
    if ((a + 0.05) / (b + 0.05) < (large ? 3 : 4.5)) say(`contrast ${((a + 0.05) / (b + 0.05)).toFixed(2)}`);
    if (scrolls(element)) continue;
    range.selectNodeContents(node);
    const text = range.getBoundingClientRect(), box = element.getBoundingClientRect();
    if (text.right > innerWidth + 1 || text.left < -1) say('beside the window');
    if (style.display !== 'inline' && (text.right > box.right + 1 || text.left < box.left - 1)) say('beside its box');
  }
  return [...new Set(found)].slice(0, 8);
})()"""

LOAD_SECONDS = "performance.getEntriesByType('navigation')[0].loadEventEnd / 1000"
# Sorts the first table with three rows or more by its last numeric column, down: the texts of that column.
SORTED = """(() => {
  const table = [...document.querySelectorAll('table')].find((t) => t.tBodies[0].rows.length > 2 && t.querySelector('th.number'));
  const heading = [...table.tHead.rows[0].cells].filter((c) => c.classList.contains('number')).at(-1);
  heading.querySelector('button').click();
  heading.querySelector('button').click();
  return [heading.ariaSort, [...table.tBodies[0].rows].map((row) => row.cells[heading.cellIndex].textContent)];
})()"""


def expect(holds, what):
    if not holds:
        failures.append(what)


def write_report():
    shutil.rmtree(FOLDER, ignore_errors=True)
    shutil.copytree(RESULTS, FOLDER, ignore=shutil.ignore_patterns("report"))
    subprocess.run([PROGRAM, "report", FOLDER], check=True, stdout=subprocess.DEVNULL)
    return FOLDER / "report"


def check_links(report):
    """Every link of every page leads to a file, and to a place in it."""
    pages = {path.name: path.read_text() for path in report.glob("*.html")}
    ids = {name: set(map(html.unescape, re.findall(r'\sid="([^"]*)"', text))) for name, text in pages.items()}
    links = 0
    for name, text in pages.items():
        for target in map(html.unescape, re.findall(r'\s(?:href|src|data|action)="([^"]*)"', text)):
            links += 1
            file, _, place = target.partition("#")
            expect((report / urllib.parse.unquote(file)).exists(), f"{name}: no file {target}")
            expect(not place or place in ids.get(file or name, ()), f"{name}: no place {target}")
    print(f"{links} links of {len(pages)} pages")
    size = len(pages["index.html"].encode())
    print(f"index.html: {size:,} bytes")
    expect(size <= MOST_BYTES, f"index.html has {size} bytes")


def take_picture(browser, name):
    if PICTURES:
        PICTURES.mkdir(parents=True, exist_ok=True)
        data = browser.call("Page.captureScreenshot", format="png")["data"]
        (PICTURES / f"{name}.png").write_bytes(base64.b64decode(data))


def check_page(browser, report, name):
    times = []
    for width in WIDTHS:
        for dark in (False, True):
            browser.open(f"{(report / name).as_uri()}", width, dark=dark)
            times.append(browser.evaluate(LOAD_SECONDS))
            where = f"{name}, {width} px, {'dark' if dark else 'light'}"
            take_picture(browser, where.replace(", ", "-").replace(" ", ""))
            for problem in browser.problems + browser.evaluate(UNREADABLE):
                expect(False, f"{where}: {problem}")
    print(f"{name}: loads in {min(times):.2f} to {max(times):.2f} s")


def check_scripts(browser, report):
    browser.open((report / "ledger.html").as_uri() + "?filter=mrbsp.T2")
    shown, top = browser.evaluate("""(() => {
      const field = document.querySelector('.filter[data-search]');
      const rows = [...document.querySelectorAll('#ledger tbody tr')].filter((row) => row.checkVisibility());
      return [rows.map((row) => row.textContent), field.getBoundingClientRect().top];
    })()""")
    expect(shown and all("mrbsp.T2" in row for row in shown), f"the filter shows {shown[:2]}")
    expect(0 <= top < 900, f"the search leads to {top} px, not to the rows")
    browser.open((report / "paper-hybrid.html").as_uri())
    order, texts = browser.evaluate(SORTED)
    numbers = [float(re.sub("[^0-9.e-]", "", text)) for text in texts if text != "–"]
    expect(order == "descending" and numbers == sorted(numbers, reverse=True) and numbers[0] > numbers[-1],
           f"sorted {order}: {texts}")


def check_slider(browser, report):
    browser.open((report / "ground-jacksboro.html").as_uri())
    clips, boxes = browser.evaluate("""new Promise((done) => {
      const details = document.querySelector('[data-panels] details'), clips = [];
      details.addEventListener('toggle', () => {
        const [left, right] = details.querySelectorAll('svg'), slider = details.querySelector('input');
        for (const value of [0, 100]) {
          slider.value = value;
          slider.dispatchEvent(new Event('input'));
          clips.push(getComputedStyle(right).clipPath);
        }
        done([clips, [left, right].map((view) => view.getAttribute('viewBox'))]);
      });
      details.open = true;
    })""")
    expect(clips[0] != clips[1], f"the slider moves nothing: {clips}")
    expect(boxes[0] != boxes[1], f"the slider compares a panel with itself: {boxes}")


def check_plots(browser, report):
    """A plot that comes into view becomes an object, whose points have titles."""
    browser.open((report / "paper-hybrid.html").as_uri())
    shown = browser.evaluate("""new Promise((done) => {
      const plot = document.querySelector('.plot');
      new MutationObserver(() => plot.children.length === 1 && done(plot.firstElementChild.data))
        .observe(plot, { childList: true });
      plot.scrollIntoView();
      setTimeout(() => done(null), 10000);
    })""")
    expect(shown, "the first plot stays an image")
    if shown:
        text = Path(urllib.parse.unquote(urllib.parse.urlparse(shown).path)).read_text()
        expect(re.search("<title>[^<]* · [^<]*: [0-9]", text), f"{shown} shows no values")


def check_checks(browser):
    """A page with every fault that the checks look for."""
    page = FOLDER / "faults.html"
    page.write_text("<body style='margin:0'><p style='width:9999px'>wide</p><p style='color:#999'>pale</p>"
                    "<p style='width:9px'>beyond</p><img src='gone.png'><script>throw new Error('thrown')</script>")
    browser.open(page.as_uri())
    found = "\n".join(browser.problems + browser.evaluate(UNREADABLE))
    for fault in ("thrown", "gone.png", "the page is 9999 wide", "contrast 2.85: pale", "beside its box: beyond"):
        expect(fault in found, f"the checks do not find '{fault}' in: {found}")


def check_without_scripts(browser, report):
    browser.call("Emulation.setScriptExecutionDisabled", value=True)
    for name in PAGES:
        browser.open((report / name).as_uri())
        document = browser.call("DOM.getDocument")["root"]["nodeId"]
        found = browser.call("DOM.querySelectorAll", nodeId=document, selector=":not(.scripted)[hidden], th button")
        expect(not found["nodeIds"], f"{name}: hidden, or needs a script")
    browser.call("Emulation.setScriptExecutionDisabled", value=False)


def main():
    program = shutil.which("chromium")
    if program is None:
        print("skipped: chromium is not installed (apt-get install --no-install-recommends chromium)")
        sys.exit(77)
    report = write_report()
    check_links(report)
    browser = Browser(program)
    try:
        for name in PAGES:
            check_page(browser, report, name)
        check_scripts(browser, report)
        check_slider(browser, report)
        check_plots(browser, report)
        check_checks(browser)
        check_without_scripts(browser, report)
    finally:
        browser.close()
    for failure in failures:
        print("FAILED:", failure)
    sys.exit(1 if failures else 0)


main()
