// pages.mjs — the pages of a printed report: every word lies within the margins of the paper, and where it is asked for no page
// but the last is less than a third full. Needs pdftotext of poppler-utils.
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';

const mm = 72 / 25.4, left = 14 * mm, right = 14 * mm, top = 14 * mm, bottom = 18 * mm;  // page.css

export const canReadPages = () => {
  try { execFileSync('pdftotext', ['-v'], {stdio: 'ignore'}); return true; } catch { return false; }
};

// Of each page its size and its words with their boxes [pt].
export function pagesOf(file) {
  const text = execFileSync('pdftotext', ['-bbox', file, '-'], {maxBuffer: 1 << 28}).toString();
  return text.split('<page ').slice(1).map(page => {
    const number = (from, name) => Number(from.match(new RegExp(`${name}="([^"]+)"`))[1]);
    const words = [...page.matchAll(/<word ([^>]*)>([^<]*)</g)].map(([, box, word]) => ({
      word, xMin: number(box, 'xMin'), xMax: number(box, 'xMax'), yMin: number(box, 'yMin'), yMax: number(box, 'yMax')}));
    return {width: number(page, 'width'), height: number(page, 'height'), words};
  });
}

// A sheet of questions: what stands in backquotes in its third column is on the page that its fourth says, give or take one
// where fonts differ.
export function checkSheet(text, pages) {
  const rows = text.split('\n').filter(line => /^\| \d+ \|/.test(line)).map(line => line.split('|').map(cell => cell.trim()));
  assert.ok(rows.length >= 10, 'ten questions');
  for (const [, number, , answer, page] of rows) {
    const near = pages.slice(Math.max(0, page - 2), Number(page) + 1).map(p => p.words.map(w => w.word));
    const quoted = [...answer.matchAll(/`([^`]+)`/g)].flatMap(m => m[1].split(' '));
    assert.ok(quoted.length > 0, `question ${number} is answered by nothing of the report`);
    assert.ok(near.some(words => quoted.every(q => words.includes(q))), `question ${number}: ${quoted} are not on page ${page}`);
  }
  return rows.length;
}

export function checkPages(pages, filled) {
  pages.forEach(({width, height, words}, i) => {
    const end = height - bottom, within = words.filter(w => w.yMin < end);  // below: the running foot
    for (const w of words) {
      const ok = w.xMin >= left - 1.5 && w.xMax <= width - right + 1.5 && w.yMin >= top - 3 && w.yMax <= height - 2;
      assert.ok(ok, `page ${i + 1}: "${w.word}" is beyond the margins (${[w.xMin, w.xMax, w.yMin, w.yMax].map(Math.round)})`);
    }
    if (!filled || i + 1 === pages.length) return;
    const full = (Math.max(...within.map(w => w.yMax), top) - top) / (end - top);
    assert.ok(full >= 1 / 3, `page ${i + 1} of ${pages.length} is ${Math.round(100 * full)} % full`);
  });
}

// Worksheets: a frame 5 mm within the paper's edge.
export function checkFrames(pages) {
  pages.forEach(({width, height, words}, i) => {
    assert.ok(words.length > 0, `page ${i + 1} is empty`);
    for (const w of words)
      assert.ok(w.xMin >= 5 * mm && w.xMax <= width - 5 * mm && w.yMin >= 5 * mm && w.yMax <= height - 5 * mm, `page ${i + 1}: "${w.word}" is beyond the frame`);
  });
}
