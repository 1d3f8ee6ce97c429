// report_test.mjs — a report in Chromium: no errors, no requests, every plot drawn, the machine moves, it prints.
// usage: node report_test.mjs report.html   (playwright-core is looked for beside this file and in KURBEL_BROWSER_MODULES)
// Ends with 77, "skipped", where there is no browser.
import assert from 'node:assert/strict';
import {existsSync} from 'node:fs';
import {createRequire} from 'node:module';
import path from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';

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

const report = path.resolve(process.argv[2]);
const browser = await chromium.launch({executablePath, args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync']});
try {
  for (const [width, colorScheme] of [[1400, 'light'], [500, 'dark']]) {
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
      assert.equal(plot.axes, 2, `"${plot.title}" lacks an axis title`);
    }

    // Nothing sticks out sideways.
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), `wider than ${width} px`);

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

    // Prints to pages.
    const pdf = await page.pdf();
    assert.ok(pdf.length > 20000 && pdf.subarray(0, 5).toString() === '%PDF-', 'prints to PDF');

    assert.deepEqual(complaints, []);
    assert.deepEqual(requests.slice(1), [], 'nothing but the page itself is asked for');
    await page.close();
    console.log(`${width} px, ${colorScheme}: ${plots.length} plots drawn, ${moves ? 'machine moves, ' : ''}${pdf.length} bytes of PDF`);
  }
} finally {
  await browser.close();
}
