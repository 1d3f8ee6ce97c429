// report_test.mjs — a report in Chromium: no errors, no requests, every plot drawn, the machine moves, it prints.
// Wide and light, and narrow and dark; of all but the first report one of the two in turn; both where KURBEL_THOROUGH is set.
// usage: node report_test.mjs report.html … (or report.html=sheet.md: its questions are answered on the pages that it says)
// sheet.html is a worksheet: each of its drawings fills a page, words lie within the frame.
// (playwright-core is looked for beside this file and in KURBEL_BROWSER_MODULES)
// Ends with 77, "skipped", where there is no browser.
import assert from 'node:assert/strict';
import {existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {createRequire} from 'node:module';
import path from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';
import {canReadPages, checkFrames, checkPages, checkSheet, pagesOf} from './pages.mjs';

function skip(reason) {
  console.log(`SKIPPED: ${reason}; scripts/install-browser installs it`);
  process.exit(77);
}

const executablePath = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync) ?? skip('no chromium here');
let chromium;
for (const folder of [process.env.KURBEL_BROWSER_MODULES, path.dirname(fileURLToPath(import.meta.url))].filter(Boolean)) {
  try { chromium ??= createRequire(path.join(folder, 'package.json'))('playwright-core').chromium; } catch { /* the next place */ }
}
if (!chromium) skip('no playwright-core here');

function printed(pdf) {
  const folder = mkdtempSync(path.join(tmpdir(), 'kurbel_pages_')), file = path.join(folder, 'report.pdf');
  writeFileSync(file, pdf);
  const pages = pagesOf(file);
  rmSync(folder, {recursive: true});
  return pages;
}

const browser = await chromium.launch({executablePath, args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync']});
try {
  const ways = [[1400, 'light'], [500, 'dark']];
  for (const [number, [report, sheet]] of process.argv.slice(2).filter(name => !name.endsWith('sheet.html')).map(name => name.split('=').map(part => path.resolve(part))).entries())
  for (const [width, colorScheme] of process.env.KURBEL_THOROUGH || number === 0 ? ways : [ways[sheet ? 0 : number % 2]]) {  // sheets: as printed from a wide window
    const page = await browser.newPage({viewport: {width, height: 900}, colorScheme});
    const complaints = [], requests = [];
    page.on('console', message => { if (['error', 'warning'].includes(message.type())) complaints.push(message.text()); });
    page.on('pageerror', error => complaints.push(error.message));
    page.on('request', request => { if (!/^(data|blob):/.test(request.url())) requests.push(request.url()); });
    await page.goto(pathToFileURL(report).href);
    await page.waitForSelector('main[data-ready]', {timeout: 60000});

    // Plots: each has lines with length in it, points, or a map, and its axes say what they are.
    const plots = await page.$$eval('.plot', list => list.map(place => ({
      lines: [...place.querySelectorAll('.scatterlayer .trace path.js-line, .barlayer .point path')].filter(line => line.getTotalLength() > 20).length
        + place.querySelectorAll('.scatterlayer .trace .points path, .imagelayer image, .layer-below image').length,
      axes: place.querySelectorAll('.xtitle, .ytitle').length,
      title: place.parentElement.querySelector('h3').textContent,
    })));
    assert.ok(plots.length > 0, 'there are plots');
    for (const plot of plots) {
      assert.ok(plot.lines > 0, `"${plot.title}" is empty`);
      if (!plot.title.endsWith('in pairs')) assert.equal(plot.axes, 2, `"${plot.title}" lacks an axis title`);
    }

    // Nothing sticks out sideways.
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), `wider than ${width} px`);

    // The rigid machine stands behind the elastic one, and is thicker, whatever the order of the data.
    const behind = await page.$$eval('.plot', list => list.map(place => {
      const data = place.data || [], lines = data.filter(t => /lines/.test(t.mode || '') && t.showlegend !== false && !t.fill);
      const grey = getComputedStyle(document.documentElement).getPropertyValue('--rigid').trim();
      const at = lines.findIndex(t => t.line.color === grey);
      return {title: place.parentElement.querySelector('h3').textContent, at, widths: lines.map(t => t.line.width)};
    }));
    for (const {title, at, widths} of behind)
      if (at > 0 || at === 0 && widths.length > 1) assert.ok(at === 0 && widths[0] >= 2 * Math.max(...widths.slice(1)), `"${title}": rigid does not stand behind`);

    // Names in the Campbell diagram cover no other, and none is cut.
    const names = await page.$$eval('.plot', list => list.filter(p => /^Campbell/.test(p.parentElement.querySelector('h3').textContent)).map(place => {
      const frame = place.getBoundingClientRect();
      return [...place.querySelectorAll('.annotation-text-g text')].map(t => {
        const {left, right, top, bottom} = t.getBoundingClientRect(), slanted = /rotate\((-40|320)/.test(t.closest('.annotation-text-g').getAttribute('transform') || '');
        return {text: t.textContent, left: left - frame.left, right: right - frame.left, top: top - frame.top, bottom: bottom - frame.top, slanted, width: frame.width, height: frame.height};
      });
    }));
    for (const diagram of names) diagram.forEach((a, i) => {
      assert.ok(a.left >= -1 && a.right <= a.width + 1 && a.top >= -1 && a.bottom <= a.height + 1, `"${a.text}" is cut at ${width} px`);
      for (const b of diagram.slice(0, i))
        assert.ok(a.slanted && b.slanted ? Math.abs(a.left - b.left) >= 17 : a.right <= b.left + 2 || b.right <= a.left + 2 || a.bottom <= b.top + 3 || b.bottom <= a.top + 3, `"${a.text}" covers "${b.text}" at ${width} px`);
    });

    // Words on the machine are readable, end within the drawing and do not cover each other.
    const words = await page.$$eval('.machine svg.line', list => list.map(svg => {
      const box = element => { const {left, right, top, bottom} = element.getBoundingClientRect(); return {left, right, top, bottom, text: element.textContent}; };
      return {frame: box(svg), words: [...svg.querySelectorAll('text')].filter(t => t.textContent && getComputedStyle(t).visibility !== 'hidden').map(box)};
    }));
    for (const drawing of words) drawing.words.forEach((a, i) => {
      assert.ok(a.bottom - a.top >= 9, `"${a.text}" is ${a.bottom - a.top} px high`);
      assert.ok(a.left >= drawing.frame.left - 1 && a.right <= drawing.frame.right + 1 && a.top >= drawing.frame.top - 1, `"${a.text}" is cut`);
      for (const b of drawing.words.slice(0, i))
        assert.ok(a.right <= b.left + 1 || b.right <= a.left + 1 || a.bottom <= b.top + 2 || b.bottom <= a.top + 2, `"${a.text}" covers "${b.text}"`);
    });

    // Headings and tiles keep their words within their cards; tables that are wider scroll in their own.
    const wide = await page.$$eval('h1, h2, h3, summary, .conclusion, .figure div, .card .note, .legend, .tools', list => list.filter(e => e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0).map(e => e.textContent.slice(0, 60)));
    assert.deepEqual(wide, [], `words stick out at ${width} px`);

    // The machine, or a pair of wheels, moves when played, and follows its sliders; reports of studies may have neither.
    const moves = await page.$('.machine') !== null, wheels = await page.$('.gears') !== null;
    if (moves) {
      const picture = () => page.$eval('.machine .stage', stage => stage.innerHTML);
      const before = await picture();
      await page.click('.machine button.play');
      await page.waitForFunction(old => document.querySelector('.machine .stage').innerHTML !== old, before, {timeout: 10000});
      await page.click('.machine button.play');
      for (const slider of wheels ? [0] : [0, 1]) {
        const still = await picture();
        await page.locator('.machine input[type=range]').nth(slider).evaluate(input => {
          input.value = 0.31 * input.max;
          input.dispatchEvent(new Event('input'));
        });
        assert.notEqual(await picture(), still, `slider ${slider} moves nothing`);
      }
      if (!wheels) await page.check('.machine input[type=checkbox]');
    }

    // A plot's data as CSV.
    const [download] = await Promise.all([page.waitForEvent('download'), page.locator('.tools a.csv').first().click()]);
    assert.match(download.suggestedFilename(), /\.csv$/);

    // Prints to pages: unfolded and at the paper's width before they are counted, as it was afterwards.
    await page.evaluate(() => addEventListener('beforeprint', () => {
      const right = document.querySelector('main').getBoundingClientRect().right;
      window.printed = {
        folded: document.querySelectorAll('details:not([open]):not(.licence)').length,
        legends: [...document.querySelectorAll('.js-plotly-plot')].filter(plot => {
          const legend = plot.querySelector('.legend'), field = plot.querySelector('.bglayer .bg, .nsewdrag');
          const [a, b] = [legend, field].map(part => part && part.getBoundingClientRect());
          return a && b && a.top < b.top && a.bottom > b.top + 4;
        }).map(plot => plot.closest('.card').textContent.slice(0, 60)),
        wide: [...document.querySelectorAll('.scroll table')].filter(t => t.getBoundingClientRect().right > right + 1).map(t => t.closest('.card').textContent.slice(0, 60)),
        broken: [...document.querySelectorAll('td.number')].filter(cell => {
          const range = document.createRange();
          range.selectNodeContents(cell);
          return new Set([...range.getClientRects()].map(box => Math.round(box.top))).size > 1;
        }).map(cell => cell.textContent),
        cut: [...document.querySelectorAll('.plot svg.main-svg')].filter(svg => svg.getBoundingClientRect().right > right + 1 || svg.getBoundingClientRect().height > svg.closest('.plot').clientHeight + 1).length,
      };
    }));
    const folded = await page.$$eval('details:not([open])', list => list.length);
    const pdf = await page.pdf({preferCSSPageSize: true});
    assert.ok(pdf.length > 20000 && pdf.subarray(0, 5).toString() === '%PDF-', 'prints to PDF');
    assert.deepEqual(await page.evaluate(() => window.printed), {folded: 0, legends: [], broken: [], cut: 0, wide: []});
    let sheets = 0;
    if (canReadPages()) {
      const pages = printed(pdf);
      checkPages(pages, width > 1000);  // filled where the window is not narrow
      if (sheet) checkSheet(readFileSync(sheet, 'utf8'), pages);
      sheets = pages.length;
      // A train's report: scope, verdict and what was not assessed are its first page.
      const second = '2 The train:';
      if (await page.$$eval('h2', (list, begin) => list.some(h => h.textContent.startsWith(begin)), second)) {
        const first = pages[0].words.map(w => w.word).join(' ');
        for (const words of ['1 Scope, verdict', 'Not assessed', 'Lateral and axial vibration']) assert.ok(first.includes(words), `"${words}" is not on the first page`);
      }
    }
    assert.equal(await page.$$eval('details:not([open])', list => list.length), folded, 'folded again');

    assert.deepEqual(complaints, []);
    assert.deepEqual(requests.slice(1), [], 'nothing but the page itself is asked for');
    await page.close();
    console.log(`${path.basename(path.dirname(report))}, ${width} px, ${colorScheme}: ${plots.length} plots drawn, ${moves ? 'machine moves, ' : ''}${pdf.length} bytes of PDF${sheets ? `, ${sheets} pages` : ''}`);
  }
  for (const report of process.argv.slice(2).filter(name => name.endsWith('sheet.html'))) {
    const page = await browser.newPage({viewport: {width: 1400, height: 900}});
    await page.goto(pathToFileURL(path.resolve(report)).href);
    const drawings = (await page.$$('main > svg')).length, pdf = await page.pdf({preferCSSPageSize: true});
    await page.close();
    assert.ok(drawings > 0, 'there are drawings');
    if (!canReadPages()) continue;
    const pages = printed(pdf);
    assert.equal(pages.length, drawings, 'a drawing fills a page');
    checkFrames(pages);
    console.log(`${path.basename(path.dirname(report))}: worksheet of ${pages.length} pages`);
  }
} finally {
  await browser.close();
}
