// page.js: builds the report from its data; text only ever goes in as text.
'use strict';
(() => {
  const report = JSON.parse(document.getElementById('data').textContent);
  const root = document.getElementById('report');

  // --- small helpers -------------------------------------------------------------------------------------------------
  function make(tag, className, text, parent) {
    const element = document.createElement(tag);
    if (className) element.className = className;
    if (text !== undefined && text !== null) element.textContent = text;
    if (parent) parent.appendChild(element);
    return element;
  }
  function draw(tag, attributes, parent, text) {
    const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const name in attributes) element.setAttribute(name, attributes[name]);
    if (text !== undefined) element.textContent = text;
    if (parent) parent.appendChild(element);
    return element;
  }
  const place = (element, attributes) => { for (const name in attributes) element.setAttribute(name, attributes[name]); };
  const colour = name => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
  const withUnit = axis => axis.unit ? `${axis.label} [${axis.unit}]` : axis.label;
  const narrow = () => window.innerWidth < 600;
  const extent = values => values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]);
  // "0.002", "3·10⁻⁷" to a few digits.
  function withPower(v, digits) {
    const [head, power] = v.toExponential(digits - 1).split('e'), n = +power, lead = +head;
    return n === 0 ? `${lead}` : n === 1 && lead === 1 ? '10' : `${lead === 1 ? '' : lead + '·'}10<sup>${n}</sup>`.replace(/-/g, '−');
  }
  const letters = text => text.replace(/<.*?>/g, '').length;
  const needsPower = v => v !== 0 && (Math.abs(v) < 1e-4 || Math.abs(v) >= 1e6);
  const shortNumber = v => needsPower(v) ? withPower(v, 4) : `${+v.toPrecision(4)}`.replace('-', '−');

  // --- plots ---------------------------------------------------------------------------------------------------------
  const plots = [];

  // About how large the field of a diagram is [px]: its place without what stands around the axes.
  const widthOf = plot => (plot.place && plot.place.clientWidth || 560) - 65;
  const heightOf = plot => (plot.place && plot.place.clientHeight || 330) - 95 - 15 * (legendRows(plot) - 1);
  const lengthOf = (plot, along) => along === 'x' ? widthOf(plot) : heightOf(plot);
  const isTold = s => Boolean(s.name) && !saysItself(s) && !(s.sizes && s.sizes.some(size => size !== s.sizes[0]));
  // Names of the legend stand in columns that are as wide as the longest; one that is wider than the page is broken.
  const nameLetters = plot => (widthOf(plot) - 45) / 6.5;
  function legendRows(plot) {
    const names = plot.series.filter(isTold).map(s => broken(s.name, nameLetters(plot)).split('\n'));
    const longest = Math.max(...names.flat().map(line => line.length), 1);
    const columns = Math.max(1, Math.floor(widthOf(plot) / (6.5 * longest + 45)));
    const lines = Math.max(...names.map(name => name.length), 1);  // a row is as high as its highest name
    return Math.max(1, columns === 1 ? names.flat().length : Math.ceil(names.length / columns) * lines);
  }

  // A curve that comes back on itself, such as a polar diagram, is read point by point; a crank that turns back a little is none.
  const wayBack = x => x.reduce((sum, value, i) => sum + (i ? Math.max(x[i - 1] - value, 0) : 0), 0);
  const isLocus = plot => plot.equalAxes || plot.series.some(s => s.labels || wayBack(s.x) > 0.2 * Math.abs(s.x[s.x.length - 1] - s.x[0]));

  const plain = text => text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/\n/g, '<br>');
  const saysItself = s => s.textAtStart || s.textAtEnd;

  function tracesOf(plot) {
    const reading = isLocus(plot) ? `(%{x:.5~g}, %{y:.5~g}) ${plot.y.unit}` : `%{y:.6~g} ${plot.y.unit}`;
    const traces = plot.map ? [mapTrace(plot)] : [];
    for (const s of plot.series) traces.push({
      x: s.x, y: s.y, name: plain(broken(s.name, nameLetters(plot))), type: plot.bars ? 'bar' : 'scatter', showlegend: isTold(s),
      marker: {color: colour(s.role), size: s.sizes ? s.sizes.map(size => 9 * size) : s.line ? 6 : 9, ...s.sizes ? {opacity: 0.75, line: {color: colour('card'), width: s.sizes[0] < 0.7 ? 0.4 : 1}} : {}},
      ...plot.bars ? {} : {
        mode: s.line ? (s.points ? 'lines+markers' : 'lines') : 'markers',
        line: {color: colour(s.role), width: saysItself(s) ? (s.role === 'rigid' || s.role === 'reference' ? 1 : 2.2) : s.behind ? 4.5 : 1.6, dash: s.dashed || s.role === 'reference' ? 'dash' : 'solid'},
      },
      ...s.labels ? {text: s.labels.map(plain)} : {}, ...saysItself(s) ? {hoverinfo: 'skip'} : {},
      ...saysItself(s) ? {} : {hovertemplate: s.sizes ? '%{text}<extra></extra>' : `${s.labels ? '%{text}<br>' : ''}${reading}<extra>${plain(s.name)}</extra>`},
    });
    traces.push(...againOnTop(plot), ...peaksOf(plot).map(circleAt));
    if (plot.marks.length) traces.push(...eventTraces(plot, rangeOf(plot).range, widthOf(plot)));
    return traces;
  }
  // Ticks at events. Where more than a few stand closer than four pixels a light band takes their place; pointing reads each.
  function eventTraces(plot, range, width) {
    const marks = [...plot.marks].sort((a, b) => a.x - b.x), near = range ? 4 * (range[1] - range[0]) / width : 0;
    const alone = marks.map(() => 1), band = {x: [], y: []};
    for (let i = 0, k = 0; i < marks.length; i = ++k) {
      while (k + 1 < marks.length && marks[k + 1].x - marks[k].x < near) ++k;
      if (k - i < 3) continue;
      alone.fill(0, i, k + 1);
      band.x.push(marks[i].x, marks[k].x, null);
      band.y.push(0.025, 0.025, null);
    }
    const common = {yaxis: 'y2', type: 'scatter', showlegend: false}, red = colour('vermillion');
    return [
      {...band, ...common, name: 'event bands', mode: 'lines', hoverinfo: 'skip', opacity: 0.35, line: {color: red, width: 9}},
      {
        x: marks.map(m => m.x), y: marks.map(() => 0.025), text: marks.map(m => plain(broken(m.text, narrow() ? 36 : 60))), ...common, name: 'events', mode: 'markers',
        cliponaxis: true, marker: {symbol: 'line-ns-open', size: 9, color: red, opacity: alone, line: {width: 1.4}},
        hovertemplate: '%{text} at %{x:.6~g}<extra></extra>',
      },
    ];
  }
  // A map is a picture below the lines (Plotly's small edition has none), a colour bar, and invisible points to point at.
  const viridis = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
  function colourAt(part) {
    const place = Math.min(Math.max(part, 0), 1) * (viridis.length - 1), i = Math.min(Math.floor(place), viridis.length - 2), f = place - i;
    return viridis[i].map((c, k) => Math.round(c + f * (viridis[i + 1][k] - c)));
  }
  // Cells end halfway between their places.
  const edgesOf = at => at.length < 2 ? [at[0] - 0.5, at[0] + 0.5] : [1.5 * at[0] - 0.5 * at[1], ...at.slice(1).map((v, i) => (v + at[i]) / 2), 1.5 * at[at.length - 1] - 0.5 * at[at.length - 2]];
  function rangeOfMap(m) {
    let low = Infinity, high = -Infinity;
    for (const row of m.z) for (const z of row) if (z !== null) { low = Math.min(low, z); high = Math.max(high, z); }
    return high > low ? [low, high] : [low - 0.5, low + 0.5];
  }
  function pictureOf(m) {
    const [low, high] = rangeOfMap(m), xs = edgesOf(m.x), ys = edgesOf(m.y), W = 900, H = 400;
    const canvas = document.createElement('canvas'), context = canvas.getContext('2d');
    canvas.width = W; canvas.height = H;
    const px = x => (x - xs[0]) / (xs[xs.length - 1] - xs[0]) * W, py = y => H - (y - ys[0]) / (ys[ys.length - 1] - ys[0]) * H;
    m.z.forEach((row, i) => row.forEach((z, k) => {
      if (z === null) return;
      context.fillStyle = `rgb(${colourAt((z - low) / (high - low))})`;
      const left = Math.floor(px(xs[k])), top = Math.floor(py(ys[i + 1]));
      context.fillRect(left, top, Math.ceil(px(xs[k + 1])) - left, Math.ceil(py(ys[i])) - top);
    }));
    return {source: canvas.toDataURL(), xref: 'x', yref: 'y', x: xs[0], y: ys[ys.length - 1], sizex: xs[xs.length - 1] - xs[0], sizey: ys[ys.length - 1] - ys[0], sizing: 'stretch', layer: 'below'};
  }
  function mapTrace(plot) {
    const m = plot.map, [low, high] = rangeOfMap(m), each = Math.ceil(m.x.length / 120), points = {x: [], y: [], text: []};
    m.y.forEach((y, i) => {
      for (let from = 0; from < m.x.length; from += each) {
        let best = from;
        for (let k = from; k < Math.min(from + each, m.x.length); ++k) if (m.z[i][k] !== null && !(m.z[i][k] <= m.z[i][best])) best = k;
        if (m.z[i][best] === null) continue;
        points.x.push(m.x[best]);
        points.y.push(y);
        points.text.push(`${m.name} ${+m.z[i][best].toPrecision(4)} ${m.unit}`);
      }
    });
    return {
      ...points, type: 'scatter', mode: 'markers', name: m.name, showlegend: false,
      marker: {
        color: points.x.map((_, i) => i ? low : high), cmin: low, cmax: high, opacity: 0, size: 8, showscale: true, colorscale: viridis.map((c, i) => [i / (viridis.length - 1), `rgb(${c})`]),
        colorbar: {title: {text: plain(broken(m.unit ? `${m.name} [${m.unit}]` : m.name, lengthOf(plot, 'y') / 6.8)), side: 'right', font: {size: 12}}, thickness: 12, outlinewidth: 0, tickfont: {size: 11}, exponentformat: 'power', minexponent: 5},
      },
      hovertemplate: `${plot.x.label} %{x:.4~g} ${plot.x.unit}<br>${plot.y.label} %{y:.4~g} ${plot.y.unit}<br>%{text}<extra></extra>`,
    };
  }
  // Where a curve in front oscillates so often that it fills a plane, what stands behind and oscillates less is traced thinly
  // upon it.
  function againOnTop(plot) {
    const turns = s => s.y.reduce((sum, y, i) => sum + (i > 1 && (y - s.y[i - 1]) * (s.y[i - 1] - s.y[i - 2]) < 0 ? 1 : 0), 0);
    const swing = s => { const late = s.y.slice(s.y.length >> 1); return Math.max(...late) - Math.min(...late); };
    const planes = plot.series.filter(s => !s.behind && s.line && !saysItself(s) && turns(s) > 120);
    return plot.series.filter(s => s.behind && planes.some(plane => swing(s) < swing(plane))).flatMap(s => [['card', 2.6], ['rigid', 1.4]].map(([name, width]) => (
      {x: s.x, y: s.y, type: 'scatter', mode: 'lines', line: {color: colour(name), width}, showlegend: false, hoverinfo: 'skip'})));
  }
  // The greatest magnitude of each curve that runs over time or speed, where there are few of them.
  function peaksOf(plot) {
    const level = s => Math.max(...s.y) - Math.min(...s.y) <= 1e-6 * Math.max(...s.y.map(Math.abs));
    const front = plot.series.filter(s => s.line && !s.points && !s.dashed && !saysItself(s) && !s.behind && s.role !== 'reference' && s.x.length > 20 && !level(s));
    if (plot.map || plot.bars || isLocus(plot) || !front.length || front.length > 3) return [];
    return front.map(s => {
      let k = 0;
      s.y.forEach((y, i) => { if (Math.abs(y) > Math.abs(s.y[k])) k = i; });
      return {x: s.x[k], y: s.y[k], role: s.role};
    });
  }
  const circleAt = peak => ({
    x: [peak.x], y: [peak.y], mode: 'markers', type: 'scatter', showlegend: false, hoverinfo: 'skip', cliponaxis: false,
    marker: {symbol: 'circle-open', size: 8, color: colour(peak.role), line: {width: 1.6}},
  });
  // Their values on the card's colour, above what is positive and below what is negative: moved out until no curve runs through
  // them, if it is not too far, and into the diagram from its sides. Heights are pixels away from the axis.
  function peakWords(plot, layout) {
    const peaks = peaksOf(plot), x = layout.xaxis.range || extent(plot.series.flatMap(s => s.x));
    const [low, high] = extent(plot.series.flatMap(s => s.y));
    if (!peaks.length || plot.x.log || plot.y.log || !(high > low)) return [];
    const W = widthOf(plot), across = W / (x[1] - x[0]), up = heightOf(plot) / (high - low), placed = [];
    return peaks.sort((a, b) => Math.abs(a.y) - Math.abs(b.y)).map(peak => {
      const text = shortNumber(peak.y), half = 3.5 * letters(text) + 4, sign = peak.y < 0 ? -1 : 1;
      const from = (peak.x - x[0]) * across, middle = Math.max(Math.min(from, W - half), half), own = sign * peak.y * up;
      const curves = plot.series.flatMap(s => s.y.filter((_, i) => Math.abs((s.x[i] - x[0]) * across - middle) < half)).map(y => sign * y * up);
      const words = placed.filter(other => other.sign === sign && Math.abs(other.middle - middle) < half + other.half);
      const at = freeAbove(own + 7, [...curves, ...words.flatMap(other => [other.at, other.at + 13])]);
      placed.push({at, middle, half, sign});
      return {
        x: peak.x, y: peak.y, text, showarrow: false, xanchor: 'center', yanchor: sign > 0 ? 'bottom' : 'top',
        xshift: middle - from, yshift: sign * (at - own), font: {size: 11, color: colour(peak.role)}, bgcolor: colour('card'), opacity: 0.92,
      };
    });
  }
  // The least height from here on at which a line of words meets none of these heights; here, where that is far away.
  function freeAbove(from, heights) {
    let at = from;
    for (;;) {
      const hit = heights.filter(y => y > at - 3 && y < at + 15);
      if (!hit.length) return at;
      at = Math.max(...hit) + 5;
      if (at > from + 50) return from;
    }
  }
  // Names on an axis; of more lines the first alone where the page is narrow.
  const shortName = name => narrow() ? name.split('\n')[0] : name;
  const placesOf = (names, text = names.map(shortName)) => ({tickvals: names.map((_, i) => i + 1), ticktext: text.map(plain)});
  // Words of a name below each other, so that each line is at most so long; null: a word alone is longer.
  function inLines(name, most) {
    const lines = [''];
    for (const word of name.split(/(?<=[ ._\n])/)) {
      if (word.trimEnd().length > most) return null;
      if ((lines[lines.length - 1] + word).trimEnd().length > most || /\n$/.test(lines[lines.length - 1])) lines.push('');
      lines[lines.length - 1] += word;
    }
    return lines.length > 4 ? null : lines.map(line => line.trim()).join('\n');
  }
  // What would exceed its space in lines that do not, as far as its words allow.
  const broken = (text, most) => text.length > most ? inLines(text, Math.max(most, 8)) || text : text;
  // From the first to the last point: markers would make room for themselves at both ends.
  function rangeOf(plot) {
    const given = plot.x.least !== undefined && plot.x.greatest !== undefined ? {range: [plot.x.least, plot.x.greatest]} : {};
    if (plot.x.names) {
      const beside = (plot.y.names || []).flatMap(name => shortName(name).split('\n')).map(line => 6.5 * line.length - 50);
      const room = (widthOf(plot) - Math.max(0, ...beside)) / plot.x.names.length / 7, text = plot.x.names.map(name => inLines(shortName(name), room));
      return {...given, ...(text.every(Boolean) ? {...placesOf(plot.x.names, text), tickangle: 0} : {...placesOf(plot.x.names), tickangle: narrow() ? -90 : -35})};
    }
    if (given.range) return given;
    // A closed curve does not touch the frame.
    if (!plot.x.log && !plot.map && isLocus(plot) && plot.series.every(s => s.line && !s.points && !saysItself(s))) {
      const [low, high] = extent(plot.series.flatMap(s => s.x)), margin = 0.04 * (high - low);
      if (margin > 0) return {range: [low - margin, high + margin]};
    }
    if (plot.x.log || plot.bars || isLocus(plot) || plot.series.some(s => s.points)) return {};
    const ends = plot.series.flatMap(s => s.x.length ? [s.x[0], s.x[s.x.length - 1]] : []);
    return ends.length && Math.min(...ends) < Math.max(...ends) ? {range: [Math.min(...ends), Math.max(...ends)]} : {};
  }
  // Ticks of a logarithmic axis say their whole value, "2·10⁻³" and not "2", and are as close as their words allow:
  // steps of round numbers where less than half a decade is seen, else all digits or some, every decade, or every so many.
  function logTicks(low, high, roomFor) {
    const exponents = Array.from({length: Math.ceil(high) - Math.floor(low) + 1}, (_, i) => Math.floor(low) + i);
    const seen = list => list.filter(v => Math.log10(v) > low - 1e-9 && Math.log10(v) < high + 1e-9);
    const choices = high - low > 0.5 ? [] : [12, 6, 4, 3, 2].map(parts => roundSteps(10 ** low, 10 ** high, parts));
    for (const leads of [[1, 2, 3, 4, 5, 6, 7, 8, 9], [1, 2, 3, 5, 7], [1, 2, 5], [1, 3], [1]]) choices.push(exponents.flatMap(n => leads.map(lead => Number(`${lead}e${n}`))));
    for (const each of [2, 3, 5, 10, 20]) choices.push(exponents.filter(n => n % each === 0).map(n => Number(`1e${n}`)));
    for (const values of choices.map(seen)) {
      const ticktext = values.map(v => values.some(needsPower) ? withPower(v, 6) : `${+v.toPrecision(6)}`);
      const apart = Math.min(...values.slice(1).map((v, i) => Math.log10(v / values[i]))) / (high - low);
      if (values.length && values.length < 13 && new Set(ticktext).size === values.length && apart >= roomFor(Math.max(...ticktext.map(letters)))) return {tickmode: 'array', tickvals: values, ticktext};
    }
    return {tickmode: 'auto'};
  }
  function roundSteps(low, high, parts) {
    const rough = (high - low) / parts, power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find(lead => lead >= rough / power - 1e-9), first = Math.ceil(low / step);
    return Array.from({length: parts + 1}, (_, i) => +((first + i) * step).toPrecision(9));
  }
  // Words beside each other need their length, words above each other their height; as parts of the axis.
  const roomFor = (along, length) => count => (along === 'x' ? 6.5 * count + 14 : 24) / length;
  function ticksOf(plot, given, along) {
    const [low, high] = given.log ? extent(plot.series.flatMap(s => s[along]).filter(v => v > 0).map(Math.log10)) : [0, -1];
    if (!(low <= high)) return {};
    const margin = high > low ? 0.06 * (high - low) : 0.5;
    return logTicks(low - margin, high + margin, roomFor(along, lengthOf(plot, along)));
  }
  // Numbers below bars: each, every other, every fifth, as there is space for their words.
  function stepOfBars(plot) {
    const [first, last] = extent(plot.series.flatMap(s => s.x)), least = (last - first + 1) * 24 / widthOf(plot);
    return [1, 2, 5, 10, 20, 50].find(step => step >= least) || 100;
  }
  function layoutOf(plot) {
    const axis = (given, along) => ({
      title: {text: plain(broken(withUnit(given), lengthOf(plot, along) / 6.8)), font: {size: 13}, standoff: 6}, type: given.log ? 'log' : 'linear', gridcolor: colour('grid'), zerolinecolor: colour('line'),
      linecolor: colour('line'), ticks: 'outside', tickcolor: colour('line'), automargin: true, exponentformat: 'power', minexponent: 5, hoverformat: '.6~g', ...ticksOf(plot, given, along),
    });
    const layout = {
      separators: '.\u2009', paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)', font: {color: colour('text'), size: 12, family: getComputedStyle(document.body).fontFamily},
      margin: {l: 10, r: 14, t: legendRows(plot) > 1 ? 21 + 19 * legendRows(plot) : 30, b: 10}, hovermode: isLocus(plot) || plot.map || plot.series.some(s => s.sizes) ? 'closest' : 'x unified', hoverlabel: {bgcolor: colour('page'), bordercolor: colour('line'), font: {color: colour('text')}},
      legend: {orientation: 'h', x: 0, y: 1.0, xanchor: 'left', yanchor: 'bottom', font: {size: 12}}, showlegend: plot.series.length > 0 && !(plot.bars && plot.x.names && plot.series.every(s => s.x.length === 1)),
      xaxis: {...axis(plot.x, 'x'), ...rangeOf(plot)}, yaxis: {...axis(plot.y, 'y'), ...(plot.y.names ? placesOf(plot.y.names) : {})}, dragmode: narrow() ? false : 'zoom',
    };
    if (plot.equalAxes) Object.assign(layout.yaxis, {scaleanchor: 'x', scaleratio: 1});
    const [low, high] = extent(plot.series.flatMap(s => s.y)), size = Math.max(Math.abs(low), Math.abs(high));
    if (plot.y.least !== undefined && plot.y.greatest !== undefined) layout.yaxis.range = [plot.y.least, plot.y.greatest];
    else if (!plot.y.log && !plot.y.names && size > 0 && size < Infinity && high - low <= 1e-9 * size) layout.yaxis.range = low < 0 ? [1.2 * low, 0] : [0, 1.2 * high];  // a constant
    if (plot.bars && !plot.x.names) Object.assign(layout.xaxis, {dtick: stepOfBars(plot)});
    if (plot.x.unit === '°' && !isLocus(plot)) Object.assign(layout.xaxis, {dtick: (narrow() ? 90 : 45) * (plot.series.some(s => s.x[s.x.length - 1] > 400) ? 2 : 1)});
    if (plot.map) {
      const ys = edgesOf(plot.map.y);
      layout.images = [pictureOf(plot.map)];
      layout.xaxis.showgrid = layout.yaxis.showgrid = false;  // its lines would look like edges of cells
      layout.yaxis.range = [ys[0], ys[ys.length - 1]];
    }
    Object.assign(layout, beside(plot, layout));
    if (plot.marks.length) layout.yaxis2 = {overlaying: 'y', range: [0, 1], visible: false, fixedrange: true};
    return layout;
  }
  // Bands along the x-axis and what is written at the ends of lines: no word covers another. Places in pixels of the frame.
  function beside(plot, layout) {
    const shapes = [], annotations = [], letter = 6.4, x = layout.xaxis.range, y = layout.yaxis.range;
    const part = (value, range) => (value - range[0]) / (range[1] - range[0]);
    // What is written at the ends of rays: at the right edge one above the other, at the top side by side.
    const right = [], top = [];
    for (const s of plot.series) {
      const last = s.x.length - 1, font = {size: 11, color: colour(s.role)};
      if (!s.textAtEnd || last < 0) continue;
      const words = {x: s.x[last], y: s.y[last], text: plain(s.textAtEnd), showarrow: false, font};
      if (y && s.y[last] >= y[1] * (1 - 1e-6)) top.push(words);
      else if (!x || s.x[last] >= x[1] * (1 - 1e-3)) right.push(words);
      else annotations.push({...words, xanchor: 'center', yanchor: 'bottom', bgcolor: colour('card'), opacity: 0.85});
    }
    // Slanted words need less height, upright ones less space beside each other: at most 40 degrees where the frame is wide.
    const tight = widthOf(plot) < 480, slant = tight ? -90 : -40, apart = tight ? 14 : 21;
    const longest = Math.max(0, ...right.map(a => a.text.length)), ceiling = Math.max(0, ...top.map(a => a.text.length));
    const beyond = tight ? 0 : Math.max(0, ...top.map(a => x ? (part(a.x, x) - 1) * widthOf(plot) + a.text.length * 5 : 0));
    const margin = {...layout.margin, r: Math.max(layout.margin.r, longest * letter + 8, beyond + 8), t: ceiling ? ceiling * (tight ? letter : 4.2) + 16 : layout.margin.t};
    const legend = ceiling ? {...layout.legend, y: -0.22, yanchor: 'top'} : layout.legend;
    const W = Math.max(100, widthOf(plot) + 14 - margin.r), H = Math.max(60, (plot.place && plot.place.clientHeight || 330) - margin.t - 62 - (ceiling ? 22 : 0));
    const spread = (list, along, range, step) => {
      list.forEach(a => { a[along] = part(a[along], range); });
      list.sort((a, b) => a[along] - b[along]);
      for (let i = 1; i < list.length; ++i) list[i][along] = Math.max(list[i][along], list[i - 1][along] + step);
      for (let i = list.length - 1, end = 1; i >= 0; --i, end -= step) list[i][along] = Math.min(list[i][along], end);
    };
    if (y) spread(right, 'y', y, 15 / H);
    if (x) spread(top, 'x', x, apart / W);
    right.forEach(a => annotations.push({...a, x: 1, xref: 'paper', yref: y ? 'paper' : 'y', xanchor: 'left', yanchor: 'middle', xshift: 3}));
    top.forEach(a => annotations.push({...a, y: 1, xref: x ? 'paper' : 'x', yref: 'paper', xanchor: tight ? 'center' : 'left', yanchor: 'bottom', textangle: slant}));

    // Words of bands stand upright below the upper edge, within their band where it begins, before a line; beside each other
    // where bands begin together.
    const taken = [];
    for (const band of plot.bands || []) {
      const line = band.from === band.to;
      shapes.push({type: line ? 'line' : 'rect', xref: 'x', yref: 'paper', x0: band.from, x1: band.to, y0: 0, y1: 1, layer: plot.map ? 'above' : 'below', fillcolor: colour(band.role), opacity: line ? 1 : 0.16, line: {width: line ? 1.4 : 0, color: colour(band.role), dash: 'dash'}});
      if (!band.text || x && (band.from > x[1] || band.to < x[0])) continue;
      const from = x ? Math.max(band.from, Math.min(x[0], band.to)) : band.from, at = x ? part(from, x) * W : 0;
      const words = {left: x ? Math.min(Math.max(line ? at - 15 : at + 1, 0), W - 15) : 0, top: 0, height: letter * band.text.length + 6};
      words.right = words.left + 14, words.bottom = words.height;
      for (const other of taken) if (x && other.left < words.right && words.left < other.right) words.left = other.right + 1, words.right = words.left + 14;
      taken.push(words);
      annotations.push({x: from, y: 1, xref: 'x', yref: 'paper', text: plain(band.text), textangle: -90, xanchor: 'left', xshift: x ? words.left - at : 0, yanchor: 'top', showarrow: false, font: {size: 11, color: colour(band.role)}, bgcolor: line ? colour('card') : 'rgba(0,0,0,0)', opacity: 0.9});
    }
    // A level line's name stands above it where it covers no other word, and circles, rays and bands leave most space; its number
    // alone where the whole has no such place. "2  ring against flywheel, 280 Hz": where the page is narrow the number alone.
    const nameLine = s => {
      const level = y ? H * (1 - part(s.y[0], y)) : 0, texts = tight ? [s.textAtStart.split(' ')[0]] : [s.textAtStart, s.textAtStart.split(' ')[0]];
      for (const text of texts) {
        const width = 7 * text.length + 6;
        const box = left => ({left, right: left + width, top: level - 16, bottom: level - 1});
        const free = left => !taken.some(o => o.left < left + width && left < o.right && o.top < level - 1 && level - 16 < o.bottom);
        const crowd = left => {
          const b = box(left), within = (px, py, pad) => px > b.left - pad && px < b.right + pad && py > b.top - pad && py < b.bottom + pad;
          let sum = 0;
          for (const other of plot.series) {
            if (other === s || !x || !y) continue;
            if (other.sizes) other.x.forEach((cx, i) => { if (within(part(cx, x) * W, H * (1 - part(other.y[i], y)), 4.5 * other.sizes[i])) sum += 1 + other.sizes[i]; });
            else if (other.textAtEnd && other.x.length === 2 && other.y[1] !== other.y[0]) {
              const cx = other.x[0] + (s.y[0] - other.y[0]) / (other.y[1] - other.y[0]) * (other.x[1] - other.x[0]), px = part(cx, x) * W;
              if (px > b.left && px < b.right) sum += 0.5;
            } else if (other.textAtStart && Math.abs(H * (1 - part(other.y[0], y)) - level + 8) < 8) sum += 1;
          }
          return sum;
        };
        const places = Array.from({length: 41}, (_, i) => i / 40 * Math.max(0, W - width)).filter(free);
        if (!places.length) continue;
        const best = places.reduce((a, b) => crowd(b) < crowd(a) - 1e-9 ? b : a);
        taken.push(box(best));
        return {text, left: best};
      }
      return null;
    };
    for (const s of plot.series) {
      if (!s.textAtStart || !s.x.length) continue;
      const name = nameLine(s);
      if (name) annotations.push({x: x ? name.left / W : s.x[0], xref: x ? 'paper' : 'x', y: s.y[0], text: plain(name.text), xanchor: 'left', yanchor: 'bottom', showarrow: false, font: {size: 12, color: colour(s.role)}, bgcolor: colour('card'), opacity: 0.9, borderpad: 1});
    }
    annotations.push(...peakWords(plot, layout));
    return {shapes, annotations, margin, legend};
  }
  function csvOf(plot) {
    const quote = text => `"${text.replace(/"/g, '""')}"`;
    if (plot.map) {
      const m = plot.map, rows = [[withUnit(plot.x), withUnit(plot.y), `${m.name} [${m.unit}]`].map(quote).join(',')];
      m.y.forEach((y, i) => m.x.forEach((x, k) => { if (m.z[i][k] !== null) rows.push([x, y, m.z[i][k]].join(',')); }));
      return rows.join('\n') + '\n';
    }
    const same = plot.series.every(s => !s.labels && s.x.length === plot.series[0].x.length && s.x.every((x, i) => x === plot.series[0].x[i]));
    if (same) {
      const rows = [[withUnit(plot.x), ...plot.series.map(s => `${s.name}: ${withUnit(plot.y)}`)].map(quote).join(',')];
      plot.series[0].x.forEach((x, i) => rows.push([x, ...plot.series.map(s => s.y[i])].join(',')));
      return rows.join('\n') + '\n';
    }
    const labelled = plot.series.some(s => s.labels), rows = [['series', withUnit(plot.x), withUnit(plot.y), ...labelled ? ['point'] : []].map(quote).join(',')];
    for (const s of plot.series) s.x.forEach((x, i) => rows.push([quote(s.name), x, s.y[i], ...labelled ? [quote(s.labels ? s.labels[i] : '')] : []].join(',')));
    return rows.join('\n') + '\n';
  }
  function addPlot(plot, card) {
    const head = make('header', '', null, card);
    make('h3', '', plot.title, head);
    const tools = make('span', 'tools', null, head);
    const link = make('a', 'csv', 'data as CSV', tools);
    link.href = '#';
    link.onclick = event => {
      event.preventDefault();
      const url = URL.createObjectURL(new Blob([csvOf(plot)], {type: 'text/csv'}));
      const save = make('a');
      save.href = url;
      save.download = plot.title.replace(/[^\w\u00c0-\uffff]+/g, '_') + '.csv';
      save.click();
      setTimeout(() => URL.revokeObjectURL(url), 10000);
    };
    const place = make('div', 'plot' + (plot.wide || narrow() && plot.bars && plot.x.names ? ' tall' : ''), null, card);
    if (plot.equalAxes) card.classList.add('polar');
    for (const [text, hint, act] of [
      ['picture', 'as PNG', () => Plotly.downloadImage(place, {format: 'png', width: 1400, height: plot.wide ? 700 : 600, filename: plot.title.replace(/[^\w\u00c0-\uffff]+/g, '_')})],
      ['whole', 'undo zooming', () => drawPlot(entry)],
    ]) {
      const tool = make('a', '', text, tools);
      tool.href = '#';
      tool.title = hint;
      tool.onclick = event => { event.preventDefault(); act(); };
    }
    const entry = {plot, place, drawn: false};
    plot.place = place;
    // Names that a narrow diagram has no room for.
    const named = narrow() ? plot.series.filter(s => s.textAtStart) : [];
    if (named.length) {
      const list = make('div', 'legend', null, card);
      for (const s of named) make('span', 'is-' + s.role, s.textAtStart, list);
    }
    if (plot.note) make('p', 'note', plot.note, card);
    else if (plot.marks.length)
      make('span', 'on-screen', ' Point at one to read it.', make('p', 'note', 'Ticks and bands below: events.', card));
    plots.push(entry);
  }
  function drawPlot(entry) {
    const {plot, place} = entry;
    place.style.height = '';
    if (legendRows(plot) > 1) place.style.height = place.clientHeight + 19 * (legendRows(plot) - 1) + 10 + 'px';  // a legend takes no space from curves
    const layout = layoutOf(plot), onPaper = root.classList.contains('printing');
    if (onPaper) Object.assign(layout, {width: place.clientWidth, height: place.clientHeight});
    else layout.autosize = true;
    if (onPaper !== Boolean(entry.onPaper)) Plotly.purge(place), entry.drawn = false;  // else the legend keeps the space that it had
    entry.onPaper = onPaper;
    Plotly.react(place, tracesOf(plot), layout, {responsive: true, displaylogo: false, displayModeBar: false});
    if (!entry.drawn && (plot.marks.length || plot.x.log || plot.y.log)) place.on('plotly_relayout', () => refine(entry));
    entry.drawn = true;
  }
  // Who looks closer sees finer ticks on logarithmic axes, and events apart that were one band.
  function refine({plot, place}) {
    const seen = place._fullLayout, first = place.data.findIndex(trace => trace.name === 'event bands'), axes = {};
    for (const along of ['x', 'y']) {
      const {range, _length} = seen[along + 'axis'];
      if (plot[along].log) for (const [key, value] of Object.entries(logTicks(...range, roomFor(along, _length)))) axes[`${along}axis.${key}`] = value;
    }
    if (first < 0) return Plotly.update(place, {}, axes);
    const [bands, events] = eventTraces(plot, seen.xaxis.range, seen.xaxis._length);
    Plotly.update(place, {x: [bands.x, events.x], y: [bands.y, events.y], 'marker.opacity': [1, events.marker.opacity]}, axes, [first, first + 1]);
  }
  const drawAll = () => plots.forEach(drawPlot);
  // One after the other, so that the page answers meanwhile.
  function drawInTurn(i) {
    if (i >= plots.length) { root.dataset.ready = 'yes'; return; }
    if (!plots[i].drawn) drawPlot(plots[i]);
    setTimeout(drawInTurn, 0, i + 1);
  }

  // --- what figures mean: links to a list at the foot ------------------------------------------------------------------
  const meanings = new Map((report.meanings || []).map(meaning => [meaning.id, meaning]));
  function meaningOf(id, parent) {
    const link = make('a', 'means', null, parent), meaning = meanings.get(id);
    link.href = '#def-' + id;
    link.title = `${meaning.title}: ${meaning.text}`;
    link.onclick = () => { document.getElementById('definitions').open = true; };
    return link;
  }
  function addMeanings() {
    const details = make('details', 'meanings', null, root);
    details.id = 'definitions';
    make('summary', '', 'What the figures mean', details);
    const list = make('dl', '', null, details);
    for (const meaning of meanings.values()) {
      make('dt', '', meaning.title, list).id = 'def-' + meaning.id;
      make('dd', '', meaning.text, list);
    }
  }

  // --- tables, formulas, text ----------------------------------------------------------------------------------------
  function fold(card, title, folded) {
    if (!folded) {
      if (title) make('h3', '', title, card);
      return card;
    }
    const details = make('details', '', null, card);
    make('summary', '', title, details);
    return details;
  }
  // Long names break behind their dots and underscores; a number and its % stay on one line.
  function write(text, place, breaks) {
    const names = breaks && (!/\s/.test(text) || /\S{26}/.test(text));
    text.replace(/(\d) %/g, '$1\u00a0%').split(/(?<=[._])/).forEach((piece, k) => { if (k && names) make('wbr', '', null, place); place.append(piece); });
  }
  function addTable(table, card) {
    const scroll = make('div', 'scroll', null, fold(card, table.title, table.folded));
    const element = make('table', table.columns.length > 9 ? 'dense' : '', null, scroll);
    const head = make('tr', '', null, make('thead', '', null, element));
    // Sentences are read from the left, wherever they stand, and so are names; a column is what more than half of it is.
    const mostly = (column, is) => { const filled = table.rows.map(row => row[column]).filter(text => text && text !== '—'); return 2 * filled.filter(is).length > filled.length; };
    const isSentence = text => text.length > 30 || /\p{L}{3,} \p{L}{3,}/u.test(text), isName = text => /^[\p{L}“"]{2}/u.test(text) && !/^(no|not) |^unbounded|^locks|^less than/.test(text);
    const kinds = table.columns.map((_, i) => i < table.textColumns || mostly(i, isSentence) ? 'text' : mostly(i, isName) ? 'name' : '');
    const kind = column => kinds[column];
    table.columns.forEach((text, i) => write(text, make('th', kind(i), '', head), true));
    const body = make('tbody', '', null, element), printed = table.rows.length > 100 ? 60 : Infinity;
    if (table.rows.length > printed) make('p', 'note on-paper', `The first ${printed} rows; the page has more.`, card);
    table.rows.forEach((row, r) => {
      const line = make('tr', r < printed ? '' : 'off-paper', null, body);
      row.forEach((text, i) => {
        const tone = table.tones ? table.tones[r][i] : '';
        const cell = make('td', [kind(i), /^[-±+−]? ?\d[^ ]*( ± \d[^ ]*)?( %)?$/.test(text) && 'number', text.length > (kind(i) === 'text' ? 34 : 22) && 'words', tone && 'tone ' + tone].filter(Boolean).join(' '), '', line);
        const place = i === 0 && table.means && table.means[r] ? meaningOf(table.means[r], cell) : cell;
        write(text, place, kind(i));
      });
    });
  }
  function addFormula(formula, card) {
    make('h3', '', formula.title, card);
    make('p', 'formula', formula.symbols, card);
    make('p', 'formula', formula.numbers, card);
    if (formula.note) make('p', 'note', formula.note, card);
  }
  function addText(text, card) {
    const inside = fold(card, text.title, text.folded);
    if (text.verbatim) make('pre', text.folded ? '' : 'wrapped', text.body, inside);
    else for (const line of text.body.split('\n')) if (line) make('p', '', line, inside);
  }

  // --- the moving machine ----------------------------------------------------------------------------------------------
  const widths = {motor: 110, coupling: 92, gearbox: 130, belt: 118, 'gear mesh': 120, 'worm gear': 120, flywheel: 90, shaft: 92, engine: 118, screw: 100, clutch: 78, brake: 78};
  const partWidth = part => part.crank ? 110 : widths[part.kind] || (/motor|turbine/.test(part.kind) ? 110 : 84);

  // A button that plays, showing the next picture after the milliseconds that have passed, and stops; sliders beside it.
  function addControls(card, showNext) {
    const controls = make('div', 'controls', null, card), play = make('button', 'play', 'Play', controls);
    play.type = 'button';
    let frame = 0, before = 0;
    function step(moment) {
      showNext(moment - before);
      before = moment;
      frame = requestAnimationFrame(step);
    }
    function stop() {
      cancelAnimationFrame(frame);
      frame = 0;
      play.textContent = 'Play';
    }
    play.onclick = () => {
      if (frame) return stop();
      play.textContent = 'Pause';
      before = performance.now();
      frame = requestAnimationFrame(step);
    };
    const slide = (text, high, name = text) => {
      const label = make('label', 'slide', null, controls);
      make('span', '', text, label);
      const input = make('input', '', null, label);
      input.type = 'range'; input.min = 0; input.max = high; input.step = 'any'; input.value = 0;
      input.setAttribute('aria-label', name);
      return [input, make('output', '', '', label)];
    };
    return {controls, slide, stop};
  }

  function addMachine(m, card) {
    card.classList.add('machine');
    const front = m.motions[m.motions.length - 1], ghosts = m.motions.slice(0, -1);
    card.style.setProperty('--front', `var(--${front.role})`);
    card.style.setProperty('--behind', `var(--${ghosts.length ? ghosts[0].role : 'rigid'})`);
    const head = make('header', '', null, card);
    make('h3', '', m.title, head);
    const stage = make('div', 'stage', null, card);
    layDown(m, front);
    const shaftLine = drawShaftLine(m, front, stage);
    const drawings = m.linkages.length > 1 ? make('div', 'linkages', null, stage) : stage;
    const mechanisms = m.linkages.map((g, k) => drawLinkage(m, g, k, front, ghosts, drawings));
    arrange(stage, shaftLine, mechanisms.map(mechanism => mechanism.svg));

    const last = m.time.length - 1, span = m.time[last] - m.time[0];
    const {controls, slide, stop} = addControls(card, passed => {
      const next = now + passed / 1000 * pace.value;
      show(next > m.time[last] ? m.time[0] : next);
    });
    const [timeSlider, timeShown] = slide('time', 1);
    const degrees = m.cycle * 180 / Math.PI;
    const [angleSlider, angleShown] = slide('angle', degrees);
    const speedLabel = make('label', '', null, controls);
    make('span', '', 'pace', speedLabel);
    const pace = make('select', '', null, speedLabel);
    const turns = Math.max(Math.abs(front.angle[last] - front.angle[0]) / (2 * Math.PI), 1e-9);
    const wanted = span / turns / 3;  // a turn in three seconds
    const paces = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];
    let chosen = paces.reduce((a, b) => Math.abs(Math.log(b / wanted)) < Math.abs(Math.log(a / wanted)) ? b : a);
    for (const p of paces) {
      const option = make('option', '', p < 1 ? `1 : ${Math.round(1 / p)}` : `${p} ×`, pace);
      option.value = p;
      option.selected = p === chosen;
    }
    const loadsLabel = make('label', '', null, controls);
    const loads = make('input', '', null, loadsLabel);
    loads.type = 'checkbox';
    make('span', '', 'forces and torques', loadsLabel);
    const legend = make('div', 'legend', null, card);
    make('span', 'is-front', front.label + (front.twistIn.length ? `: twists reduced to ${m.link}, enlarged ${m.enlargement.toLocaleString('en')} ×` : ''), legend);
    if (ghosts.length) make('span', 'is-behind', `${ghosts.map(g => g.label).join(', ')}, behind`, legend);
    else if (front.twistIn.length) make('span', 'is-untwisted', 'without twist', legend);
    make('span', 'plain', `all shafts are drawn at the speed of ${m.link}`, legend);

    // One frame.
    let now = m.time[0];
    function show(t) {
      now = Math.min(Math.max(t, m.time[0]), m.time[last]);
      const place = (now - m.time[0]) / span * last;
      const i = Math.min(Math.floor(place), last - 1), share = place - i;
      const at = list => list && list.length ? list[i] + share * (list[i + 1] - list[i]) : 0;
      shaftLine.update(at, loads.checked);
      mechanisms.forEach(mechanism => mechanism.update(at, loads.checked));
      const angle = at(front.angle), within = ((angle % m.cycle) + m.cycle) % m.cycle;
      timeSlider.value = (now - m.time[0]) / span;
      angleSlider.value = within * 180 / Math.PI;
      timeShown.textContent = now.toFixed(span < 1 ? 4 : 3) + ' s';
      angleShown.textContent = (within * 180 / Math.PI).toFixed(1) + '°';
      card.dataset.time = now;
    }
    timeSlider.oninput = () => { stop(); show(m.time[0] + timeSlider.value * span); };
    // The angle is sought in the last whole cycle.
    angleSlider.oninput = () => {
      stop();
      const rising = front.angle[last] >= front.angle[0];
      const end = Math.floor(Math.max(front.angle[last], front.angle[0]) / m.cycle + 1e-9) * m.cycle;
      const target = end - m.cycle + angleSlider.value * Math.PI / 180;
      let low = 0, high = last;
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if ((front.angle[middle] < target) === rising) low = middle; else high = middle;
      }
      const rise = front.angle[high] - front.angle[low];
      const kept = angleSlider.value;
      show(m.time[low] + (rise ? Math.min(Math.max((target - front.angle[low]) / rise, 0), 1) : 0) * (m.time[high] - m.time[low]));
      angleSlider.value = kept;
    };
    loads.onchange = () => show(now);
    // It starts where it is twisted most, or pushed hardest.
    let most = Math.floor(0.37 * last / Math.max(turns, 1)), highest = 0;
    for (const list of front.twistIn.length ? [...front.twistIn, ...front.twistOut] : front.force)
      list.forEach((value, i) => { if (Math.abs(value) > highest * 1.001) { highest = Math.abs(value); most = i; } });
    show(m.time[most]);
  }

  // Shaft line and mechanism beside each other, equally high, where that leaves the line's words readable; else below.
  // Words come out at some 13 pixels however much the drawing is enlarged, and end within it.
  // Names above their parts, each in the lowest of three rows in which it keeps clear of its neighbour.
  function placeNames(line, size) {
    const box = line.svg.viewBox.baseVal, rows = [38, 18, -2], ends = {};
    for (const {text, middle, top, high} of line.names) {
      const half = 0.31 * size * text.textContent.length + 2, x = Math.min(Math.max(middle, half), box.width - half);
      const end = y => ends[top + y] ?? -Infinity, open = rows.slice(high ? 1 : 0);
      const y = open.find(y => end(y) + 4 < x - half) ?? open.reduce((a, b) => end(b) < end(a) ? b : a);
      ends[top + y] = x + half;
      place(text, {x, y: top + y});
    }
    if (ends[rows[2]] !== undefined) line.svg.setAttribute('viewBox', `0 -22 ${box.width} ${box.height + 22}`);
  }
  function arrange(stage, line, linkages) {
    const box = line.svg.viewBox.baseVal, ratio = svg => svg.viewBox.baseVal.width / svg.viewBox.baseVal.height;
    const room = Math.min(1400, window.innerWidth) - (narrow() ? 44 : 110), high = linkages.length === 1 ? room / (ratio(line.svg) + ratio(linkages[0])) : 0;
    const beside = window.innerWidth > 900 && high > 0.75 * box.height;
    if (beside) {
      stage.classList.add('beside');
      stage.style.setProperty('--sides', [line.svg, linkages[0]].map((svg, k) => `minmax(${k ? 200 : 0}px, ${ratio(svg).toFixed(3)}fr)`).join(' '));
    }
    // Several mechanisms share the width in columns of at least 200 pixels.
    const columns = Math.max(1, Math.min(linkages.length, Math.floor((room + 16) / 216))), most = linkages.length > 1 || linkages.some(svg => ratio(svg) > 2) ? 300 : 460;
    for (const svg of linkages) {
      svg.style.setProperty('--tall', `${beside ? 460 : most}px`);
      const {width, height} = svg.viewBox.baseVal, scale = beside ? high / height : Math.min(room / columns / width, most / height);
      const size = Math.min(13 / scale, 22);
      svg.style.setProperty('--words', `${size.toFixed(1)}px`);
      svg.raise(size);
    }
    const words = Math.min(13 / Math.min(beside ? high / box.height : room / box.width, parseFloat(line.svg.style.maxHeight) / box.height), 24);
    // On paper some 650 pixels wide, whatever the window.
    const printed = beside ? 1.4 * words : 9.2 / Math.min(650 / box.width, parseFloat(line.svg.style.maxHeight) / box.height);
    line.svg.style.setProperty('--words', `${words.toFixed(1)}px`);
    line.svg.style.setProperty('--printed', `${printed.toFixed(1)}px`);
    placeNames(line, Math.max(words, printed));
  }

  // What stands on a shaft, seen from the side: each draws itself about (x, y) and says how thick it is along the shaft.
  const body = (svg, x, y, w, h, kind = 'body', rx = 3) => draw('rect', {x: x - w / 2, y: y - h / 2, width: w, height: h, rx, class: kind}, svg);
  const stroke = (svg, x1, y1, x2, y2, width = 1.2, name = 'var(--metal-edge)') => draw('line', {x1, y1, x2, y2, stroke: name, 'stroke-width': width}, svg);
  const symbols = {
    clutch(svg, x, y) {  // two plates with their linings
      for (const s of [-1, 1]) { body(svg, x + 9 * s, y, 10, 84); body(svg, x + 2 * s, y, 3, 76, 'part', 0); }
      return 28;
    },
    'one-way clutch'(svg, x, y) {
      for (const s of [-1, 1]) body(svg, x + 8 * s, y, 12, 62);
      draw('polyline', {points: `${x - 6},${y - 40} ${x + 6},${y - 40} ${x + 1},${y - 45} ${x + 6},${y - 40} ${x + 1},${y - 35}`, class: 'front', 'stroke-width': 2}, svg);
      return 28;
    },
    'torque limiter'(svg, x, y) {
      for (const s of [-1, 1]) body(svg, x + 9 * s, y, 10, 70);
      stroke(svg, x - 4, y - 30, x + 4, y - 30, 3, 'var(--orange)');
      stroke(svg, x - 4, y + 30, x + 4, y + 30, 3, 'var(--orange)');
      return 28;
    },
    brake(svg, x, y) {  // a disc between shoes that hold to the frame
      body(svg, x, y, 12, 84);
      for (const s of [-1, 1]) {
        body(svg, x, y + 48 * s, 26, 10, 'part', 1);
        for (let k = -2; k <= 2; ++k) stroke(svg, x + 5 * k, y + 54 * s, x + 5 * k - 5, y + 61 * s);
        stroke(svg, x - 15, y + 54 * s, x + 15, y + 54 * s, 1.6);
      }
      return 14;
    },
    'viscous damper'(svg, x, y) {  // a ring in its housing
      body(svg, x, y, 34, 104);
      for (const s of [-1, 1]) body(svg, x, y + 34 * s, 22, 26, 'part', 2);
      return 34;
    },
    'fluid coupling'(svg, x, y) {
      for (const s of [-1, 1]) draw('path', {d: `M${x + 3 * s},${y - 46} A30,46 0 0 ${s > 0 ? 1 : 0} ${x + 3 * s},${y + 46} Z`, class: 'body'}, svg);
      return 50;
    },
    'planetary gear'(svg, x, y) {  // ring, planets, sun
      body(svg, x, y, 30, 104);
      for (const s of [-1, 1]) body(svg, x, y + 33 * s, 20, 24, 'shaft', 2);
      body(svg, x, y, 20, 36, 'shaft', 2);
      return 32;
    },
    shaft(svg, x, y, p) {  // longer and thinner than what it joins
      body(svg, x, y, 64, 22, 'shaft', 1);
      if (p.elastic) for (const k of [-2, -1, 0, 1, 2]) stroke(svg, x + 11 * k - 5, y + 11, x + 11 * k + 5, y - 11, 1.2);
      return 64;
    },
    engine(svg, x, y) {  // a block with its cylinders
      body(svg, x, y - 8, 92, 96, 'body', 6);
      for (const k of [-1.5, -.5, .5, 1.5]) { body(svg, x + 21 * k, y - 36, 14, 30, 'dial', 2); body(svg, x + 21 * k, y - 30 + 5 * (Math.round(k * 2 + 5) % 3 - 1), 13, 9, 'shaft', 1); }
      return 94;
    },
    load(svg, x, y, p) {  // blades of what moves a fluid; else a disc
      if (!/fan|pump|blower|propeller|impeller|screw|turbine|ventilator/i.test(p.name)) { body(svg, x, y, 22, 76, 'body', 4); return 22; }
      body(svg, x, y, 18, 44);
      for (const s of [-1, 1]) draw('path', {d: `M${x - 8},${y + 22 * s} q-7,${20 * s} 8,${26 * s} q15,${-6 * s} 8,${-26 * s} Z`, class: 'body'}, svg);
      return 26;
    },
    bearing(svg, x, y) {  // a pedestal
      body(svg, x, y, 30, 40, 'body', 6);
      for (const s of [-1, 1]) stroke(svg, x - 15, y + 20 * s, x + 15, y + 20 * s, 3);
      draw('polygon', {points: `${x - 9},${y + 20} ${x + 9},${y + 20} ${x + 18},${y + 46} ${x - 18},${y + 46}`, class: 'body'}, svg);
      for (let k = -2; k <= 2; ++k) stroke(svg, x + 8 * k, y + 46, x + 8 * k - 6, y + 53);
      return 30;
    },
    differential(svg, x, y) {  // cage with its bevel gears
      body(svg, x, y, 56, 96, 'body', 8);
      for (const s of [-1, 1]) {
        draw('polygon', {points: `${x + 22 * s},${y - 24} ${x + 22 * s},${y + 24} ${x + 10 * s},${y + 12} ${x + 10 * s},${y - 12}`, class: 'shaft'}, svg);
        draw('polygon', {points: `${x - 22},${y + 36 * s} ${x + 22},${y + 36 * s} ${x + 11},${y + 23 * s} ${x - 11},${y + 23 * s}`, class: 'shaft'}, svg);
      }
      return 56;
    },
    wedge(svg, x, y) {
      body(svg, x, y, 14, 60);
      draw('polygon', {points: `${x + 7},${y + 42} ${x + 40},${y + 42} ${x + 7},${y + 20}`, class: 'part'}, svg);
      return 14;
    },
    slide(svg, x, y) {  // a block on its way
      body(svg, x, y, 14, 60);
      body(svg, x + 24, y + 36, 30, 16, 'part', 1);
      stroke(svg, x, y + 45, x + 46, y + 45, 2);
      return 14;
    },
    screw(svg, x, y) {
      body(svg, x, y, 66, 30, 'shaft', 1);
      for (let k = -4; k <= 4; ++k) stroke(svg, x + 7 * k - 3, y + 15, x + 7 * k + 3, y - 15, 1.4);
      body(svg, x + 8, y, 22, 58);
      return 66;
    },
  };
  const stepsDown = kind => ['gearbox', 'gear mesh', 'belt', 'worm gear'].includes(kind);
  const couples = kind => /coupling$/.test(kind) && kind !== 'fluid coupling' || kind === 'universal joint';

  // Pairs of wheels, pulleys with their belt, worm and wheel: from the shaft at y to the one at `out`.
  function drawStep(svg, x, y, out, p) {
    const i = Math.abs(p.ratioIn / p.ratioOut), high = i > 1 ? 1 / i : 1;
    if (p.kind === 'belt') {  // both pulleys in one plane, the belt about them
      const down = Math.sign(out - y), small = Math.min(20, 46 * high), large = Math.min(40, small / Math.max(high, 0.2));
      const first = i > 1 ? small : large, second = i > 1 ? large : small;
      draw('rect', {x: x - 6, y: Math.min(y - down * first, out + down * second), width: 12, height: Math.abs(out - y) + first + second, rx: 5, class: 'belt'}, svg);
      body(svg, x, y, 20, 2 * first - 5, 'body', 2);
      body(svg, x, out, 20, 2 * second - 5, 'body', 2);
    } else if (p.kind === 'worm gear') {
      body(svg, x, out, 12, 76);
      for (let k = -4; k <= 4; ++k) stroke(svg, x - 6, out + 8 * k, x + 6, out + 8 * k, 0.5);
      body(svg, x - 6, y, 56, 28, 'body', 2);
      for (let k = -3; k <= 3; ++k) stroke(svg, x - 9 + 8 * k, y + 14, x - 3 + 8 * k, y - 14, 1.4);
    } else {
      const rIn = 12 + 30 * Math.sqrt(high) * (i > 1 ? 0.6 : 1), rOut = Math.max(60 - rIn, 14);
      for (const [c, at, r] of [[x - 10, y, rIn], [x + 10, out, rOut]]) {
        body(svg, c, at, 14, 2 * r, 'body', 2);
        for (let k = -3; k <= 3; ++k) stroke(svg, c - 7, at + k * r / 3.6, c + 7, at + k * r / 3.6, 0.5);
      }
    }
  }

  // Of each line of parts; of a long one both ends, and where the page is narrow one piece below the other.
  function lanesOf(m) {
    const most = 14, atOnce = narrow() ? 5 : Infinity, lanes = [];
    for (const row of [...new Set(m.parts.map(p => p.row))]) {
      let list = m.parts.map((p, k) => ({p, k})).filter(e => e.p.row === row).map(e => e.p.kind === 'gap' ? null : e);
      if (list.length > most + 1) list = [...list.slice(0, most / 2), null, ...list.slice(-most / 2)];
      const pieces = Math.ceil(list.length / atOnce) || 1, length = Math.ceil(list.length / pieces);
      for (let i = 0; i < pieces; ++i) lanes.push({row, list: list.slice(i * length, (i + 1) * length), begins: i === 0, ends: i === pieces - 1});
    }
    return lanes;
  }

  // A row for each line, and lines of few parts beside the one before where that leaves space; from where each begins.
  function putLanes(lanes, lengthOf) {
    const widest = Math.max(420, ...lanes.map(lane => lengthOf(lane.list))), most = Math.max(widest, narrow() ? 0 : 1100), rows = [];
    for (const lane of lanes) {
      const before = rows[rows.length - 1], length = lengthOf(lane.list), whole = lane.begins && lane.ends;
      if (before && whole && before.whole && before.length + length <= most) Object.assign(lane, {level: rows.length - 1, left: before.length});
      else { Object.assign(lane, {level: rows.length, left: 0}); rows.push({length: 0, whole}); }
      rows[lane.level].length += length;
    }
    const width = Math.max(420, ...rows.map(row => row.length));
    for (const lane of lanes) lane.left += (width - rows[lane.level].length) / 2;
    return {width, rows: rows.length};
  }

  // Parts side by side, a line painted along the shafts, and a dial below each part.
  function drawShaftLine(m, front, stage) {
    const ghost = m.motions.length > 1 ? m.motions[0] : null;
    const lanes = lanesOf(m), gap = 22, R = 13;
    // Steps down and up a lane: what they add up to makes space above and below. Ties run below the dials.
    const stepOf = p => stepsDown(p.kind) ? (p.kind === 'belt' ? 52 : 34) * (Math.abs(p.ratioIn) > Math.abs(p.ratioOut) ? 1 : -1) : 0;
    const halfOf = p => p.kind === 'flywheel' || p.kind === 'brake' ? 64 : 54;
    let raise = 0, deepest = 0;
    for (const {list} of lanes) {
      let at = 0;
      for (const e of list) if (e) { at += stepOf(e.p); deepest = Math.max(deepest, at + halfOf(e.p)); raise = Math.max(raise, -at); }
    }
    const axis = 112 + raise, dials = axis + deepest + 62, tied = m.ties.length || lanes.some(lane => !lane.begins), rowHeight = dials + (tied ? 71 : 41);
    const lengthOf = list => list.reduce((sum, e) => sum + (e ? partWidth(e.p) : 40) + gap, gap);
    const {width, rows} = putLanes(lanes, lengthOf);
    const svg = draw('svg', {viewBox: `0 0 ${width} ${rowHeight * rows}`, class: 'line', role: 'img'}, stage);
    svg.style.maxHeight = `${rows > 1 ? Math.min(460, rowHeight) * rows : 460}px`;  // several rows are not enlarged
    draw('title', {}, svg, 'Shaft line');
    const updates = [], stations = [], names = [];
    const ends = [], shaftsOf = [];  // of each lane: its first and last point; of each part: its two shafts
    const under = draw('g', {}, svg);  // ties between the lanes, behind everything
    lanes.forEach(({row, list, begins, ends: closes, level, left}, r) => {
      const comesFrom = !begins || m.ties.some(tie => tie.row === row && !tie.atEnd), goesTo = !closes || m.ties.some(tie => tie.row === row && tie.atEnd);
      let x = gap + left, y = rowHeight * level + axis, line = [];
      stations.push(line);
      list.forEach((entry, n) => {
        if (!entry) {
          draw('text', {x: x + 10, y: y + 5}, svg, '…');
          stations.push(line = []);
          x += 40 + gap;
          return;
        }
        const {p, k} = entry, w = partWidth(p), kind = p.kind, middle = x + w / 2, out = y + stepOf(p);
        // Shafts to both neighbours.
        const shaft = (a, b, at) => draw('rect', {x: a, y: at - R, width: b - a, height: 2 * R, class: 'shaft'}, svg);
        shaftsOf[k] = {level, middle, in: {x: x - gap / 2, y}, out: {x: x + w + gap / 2, y: out}};
        ends[r] = {first: ends[r] ? ends[r].first : {x: x - gap / 2, y}, last: {x: x + w + gap / 2, y: out}};
        const joins = couples(kind) || stepsDown(kind);
        if (n > 0 || comesFrom || joins) shaft(x - gap / 2, middle, y);
        if (n < list.length - 1 || goesTo || joins) shaft(middle, x + w + gap / 2, out);
        line.push({x: x - gap / 2, y, k, side: 'twistIn'});
        if (stepsDown(kind)) {
          line.push({x: middle - 6, y, k, side: 'twistIn'});
          stations.push(line = []);
          line.push({x: middle + 6, y: out, k, side: 'twistOut'});
          drawStep(svg, middle, y, out, p);
          draw('text', {x: middle, y: Math.min(y, out) - 62, 'text-anchor': 'middle', class: 'soft'}, svg, `i = ${+(p.ratioIn / p.ratioOut).toPrecision(4)}`);
        } else if (couples(kind)) {
          line.push({x: middle - 12, y, k, side: 'twistIn'}, {x: middle + 12, y, k, side: 'twistOut'});
          for (const s of [-1, 1]) draw('rect', {x: middle + (s < 0 ? -26 : 12), y: y - 34, width: 14, height: 68, rx: 3, class: 'body'}, svg);
          if (kind === 'universal joint') {
            for (const s of [-1, 1]) { stroke(svg, middle - 12, y - 22 * s, middle + 2, y, 6); stroke(svg, middle + 12, y - 22 * s, middle - 2, y, 6); }
            draw('circle', {cx: middle, cy: y, r: 6, class: 'dial'}, svg);
          } else if (p.elastic) draw('polyline', {points: [-12, -8, -4, 0, 4, 8, 12].map((d, j) => `${middle + d},${y - 24 + (j % 2 ? -5 : 5)}`).join(' '), class: 'front', 'stroke-width': 1.6}, svg);
          else draw('rect', {x: middle - 12, y: y - 27, width: 24, height: 6, class: 'shaft'}, svg);
        } else {
          const height = /flywheel/.test(kind) ? 128 : /motor|turbine/.test(kind) ? 92 : 84;
          const plainThick = /flywheel/.test(kind) ? 34 : /motor|turbine/.test(kind) ? w - 16 : p.crank ? 0 : 26;
          const drawn = symbols[kind] ? symbols[kind](svg, middle, y, p) : 0;
          const thick = drawn || plainThick;
          if (thick && !drawn) body(svg, middle, y, thick, height, 'body', /motor/.test(kind) ? 8 : 3);
          if (/motor/.test(kind)) for (let j = 1; j < 6; ++j) stroke(svg, middle - thick / 2 + 8, y - height / 2 + j * height / 6, middle + thick / 2 - 8, y - height / 2 + j * height / 6, 0.6);
          if (p.crank) {
            shaft(middle, middle + 22, y);
            const web = draw('rect', {class: 'body', x: middle + 14, width: 12}, svg), pin = draw('rect', {class: 'shaft', x: middle + 26, width: 26, height: 12}, svg);
            const at0 = y, pinHeight = pinHeightOf(m, front, k);
            updates.push(at => {
              const h = 40 * pinHeight(at);
              place(web, {y: at0 + Math.min(0, -h) - 10, height: Math.abs(h) + 20});
              place(pin, {y: at0 - h - 6});
            });
          }
          if (!/motor|turbine/.test(kind) || n > 0 || comesFrom) line.push({x: middle - thick / 2, y, k, side: 'twistIn'});
          line.push({x: middle + thick / 2 + (p.crank ? 14 : 0), y, k, side: 'twistOut'});
          if (n === 0 && !comesFrom) line.shift();
        }
        if (n < list.length - 1 || goesTo) line.push({x: x + w + gap / 2, y: out, k, side: 'twistOut'});
        // Name, and the dial.
        const name = p.name.length > 20 ? p.name.slice(0, 19) + '…' : p.name;
        names.push({text: draw('text', {x: middle, 'text-anchor': 'middle'}, svg, name), middle, top: rowHeight * level, high: stepsDown(kind)});
        updates.push(drawDial(m, front, ghost, k, middle, rowHeight * level + dials, svg));
        x += w + gap;
        y = out;
      });
    });
    // A line begins, and may end, at a shaft of another, and goes on below where it was cut: drawn as a way round the dials.
    const tie = (from, a, b, atEnd, n) => {
      const shelf = rowHeight * from.level + dials + 42 + 8 * (n % 3), aside = atEnd ? Math.min(width - 4, b.x + 10) : Math.max(4, b.x - 10);
      draw('polyline', {points: `${from.middle},${a.y} ${a.x},${a.y} ${a.x},${shelf} ${aside},${shelf} ${aside},${b.y} ${b.x},${b.y}`, class: 'tie'}, under);
    };
    m.ties.forEach((t, n) => {
      const to = shaftsOf[t.part], own = t.atEnd ? lanes.findLastIndex(lane => lane.row === t.row) : lanes.findIndex(lane => lane.row === t.row);
      if (!to || !ends[own]) return;
      const a = t.out ? to.out : to.in;
      tie(to, a, t.atEnd ? ends[own].last : ends[own].first, t.atEnd, n);
      draw('circle', {cx: a.x, cy: a.y, r: 4, class: 'tie-end'}, svg);
    });
    lanes.forEach((lane, r) => { if (!lane.begins && ends[r] && ends[r - 1]) tie({level: lanes[r - 1].level, middle: ends[r - 1].last.x}, ends[r - 1].last, ends[r].first, false, 0); });
    const angleOf = (motion, s, at) => at(motion.angle) + apartOf(m, motion, s.k, s.side === 'twistOut', at);
    for (const line of stations.filter(l => l.length > 1)) {
      const background = draw('polyline', ghost ? {class: 'ghost', 'stroke-width': 8} : {class: 'untwisted'}, svg);
      const paint = draw('polyline', {class: 'front', 'stroke-width': 3.2, 'stroke-linejoin': 'round'}, svg);
      updates.push(at => {
        const pointsOf = angle => line.map(s => `${s.x.toFixed(1)},${(s.y - R * Math.sin(angle(s))).toFixed(2)}`).join(' ');
        place(paint, {points: pointsOf(s => angleOf(front, s, at)), opacity: Math.cos(angleOf(front, line[0], at)) >= 0 ? 1 : 0.25});
        if (ghost || front.twistIn.length) place(background, {points: pointsOf(s => ghost ? angleOf(ghost, s, at) : at(front.angle) + slipOf(front, s.k, s.side === 'twistOut', at)), opacity: Math.cos(at(ghost ? ghost.angle : front.angle)) >= 0 ? 0.6 : 0.15});
      });
    }
    return {svg, names, update: (at, loads) => updates.forEach(update => update(at, loads))};
  }

  // Where a mechanism's joint stands at an angle of its crank: by table over 240 places a turn, of which a cycle may have two.
  function jointsOf(g) {
    const steps = g.x[0].length - 1, turns = Math.max(1, Math.round(steps / 240));
    return (k, angle) => {
      const place = ((angle / (2 * Math.PI * turns)) % 1 + 1) % 1 * steps, i = Math.min(Math.floor(place), steps - 1), share = place - i;
      return [g.x, g.y].map(list => list[k][i] + share * (list[k][i + 1] - list[k][i]));
    };
  }
  // The angle of a mechanism's crank: in its own speed, and with what slips between it and the link.
  function crankAngle(m, g, motion, at) {
    const k = m.parts.findIndex(p => p.name === g.name);
    return g.ratio * (at(motion.angle) + (k < 0 ? 0 : slipOf(motion, k, true, at)));
  }
  // How high the pin of a part's crank stands, as part of its throw: as the view of its mechanism shows it, in its phase and
  // direction. Of many mechanisms the last have no view.
  function pinHeightOf(m, front, k) {
    const part = m.parts[k], g = m.linkages.find(linkage => linkage.name === part.name);
    if (!g) return at => Math.sin(part.ratioOut * (at(front.angle) + slipOf(front, k, true, at)));
    const jointAt = jointsOf(g), c = Math.cos(g.direction), s = Math.sin(g.direction);
    return at => {
      const angle = crankAngle(m, g, front, at), bearing = jointAt(0, angle), pin = jointAt(1, angle);
      const [u, v] = [0, 1].map(axis => pin[axis] - bearing[axis]);
      return (u * s + v * c) / (Math.hypot(u, v) || 1);
    };
  }

  // By how much a part's shaft stands before the link: its twist enlarged, its slip as it is.
  function apartOf(m, motion, k, out, at) {
    const twist = out ? motion.twistOut : motion.twistIn;
    return (twist.length ? m.enlargement * at(twist[k]) : 0) + slipOf(motion, k, out, at);
  }
  function slipOf(motion, k, out, at) {
    const slip = out ? motion.slipOut : motion.slipIn;
    return slip ? at(slip[k]) : 0;
  }
  const hand = (x, y, r, angle) => ({x1: x, y1: y, x2: x + r * Math.cos(angle), y2: y - r * Math.sin(angle)});
  const withPrefix = (value, unit) => Math.abs(value) >= 1e6 ? `${+(value / 1e6).toPrecision(3)} M${unit}` : Math.abs(value) >= 1000 ? `${+(value / 1000).toPrecision(3)} k${unit}` : `${Math.abs(value) < 0.5 ? 0 : +value.toPrecision(3)} ${unit}`;
  function drawArrowHead(path, head, x, y, direction, size) {
    const c = Math.cos(direction), s = Math.sin(direction);
    place(head, {points: [[size, 0], [-size * 0.5, size * 0.65], [-size * 0.5, -size * 0.65]].map(([a, b]) => `${x + a * c - b * s},${y - a * s - b * c}`).join(' ')});
  }

  // Hands of both sides of a part, the angle between them filled; on demand its torque as an arc.
  function drawDial(m, front, ghost, k, x, y, svg) {
    const r = 27;
    draw('circle', {cx: x, cy: y, r, class: 'dial'}, svg);
    const wedge = draw('path', {class: 'wedge'}, svg);
    const grey = draw('line', ghost ? {class: 'ghost', 'stroke-width': 7, opacity: 0.6} : {class: 'untwisted'}, svg);
    const input = draw('line', {class: 'front', 'stroke-width': 1.6, opacity: .65}, svg), output = draw('line', {class: 'front', 'stroke-width': 3}, svg);
    const torque = front.torque[k] || [];
    const shown = torque.length > 0;
    const largest = torque.reduce((a, b) => Math.max(a, Math.abs(b)), 1e-12);
    const group = draw('g', {}, svg), arc = draw('path', {class: 'arrow'}, group), head = draw('polygon', {class: 'head'}, group);
    const text = draw('text', {x, y: y - 44, 'text-anchor': 'middle', class: 'load'}, group);
    return (at, loads) => {
      const base = at(front.angle), a = base + apartOf(m, front, k, false, at), b = base + apartOf(m, front, k, true, at);
      place(grey, hand(x, y, r, ghost ? at(ghost.angle) + apartOf(m, ghost, k, true, at) : base + slipOf(front, k, true, at)));
      place(input, hand(x, y, r, a));
      place(output, hand(x, y, r, b));
      // What slips has turned apart by many turns: the part of one is shown.
      const apart = (b - a) % (2 * Math.PI), to = a + apart, sweep = apart > 0 ? 0 : 1;
      place(wedge, {d: Math.abs(apart) < 1e-3 || !(m.parts[k].elastic || m.parts[k].slips) ? '' : `M${x},${y} L${x + r * Math.cos(a)},${y - r * Math.sin(a)} A${r},${r} 0 ${Math.abs(apart) > Math.PI ? 1 : 0} ${sweep} ${x + r * Math.cos(to)},${y - r * Math.sin(to)} Z`});
      group.setAttribute('visibility', loads && shown ? 'visible' : 'hidden');
      if (!loads || !shown) return;
      const value = at(torque), turn = 2.6 * value / largest, R = r + 7, start = Math.PI / 2 - turn / 2, end = start + turn;
      place(arc, {d: `M${x + R * Math.cos(start)},${y - R * Math.sin(start)} A${R},${R} 0 0 ${turn > 0 ? 0 : 1} ${x + R * Math.cos(end)},${y - R * Math.sin(end)}`});
      drawArrowHead(arc, head, x + R * Math.cos(end), y - R * Math.sin(end), end + (turn > 0 ? 1 : -1) * Math.PI / 2, Math.abs(turn) < 0.08 ? 0 : 8);
      text.textContent = withPrefix(value, 'N·m');
    };
  }

  // What is seen of a mechanism, in its axes: along its stroke and across, and the measures of its parts.
  function fieldOf(g, forced) {
    const least = lists => Math.min(...lists.map(list => Math.min(...list))), most = lists => Math.max(...lists.map(list => Math.max(...list)));
    const size = Math.max(most(g.x) - least(g.x), most(g.y) - least(g.y)), body = 0.13 * size, room = 0.3 * size;
    const slider = g.links.find(link => link.shape === 'slider'), end = g.output, guided = slider ? slider.joints[0] : end;
    // What the load acts on slides, else it rocks about a bearing.
    const carried = g.links.find(link => (link.shape === 'slider' || link.shape === 'point') && link.joints[0] === end);
    const far = most(g.x) + (carried ? body + (forced ? 0.55 * room : 0) : 0.4 * body), aside = (g.load === 'press' ? 1.25 : 0.75) * body;
    const way = slider ? [g.y[guided][0] - aside, g.y[guided][0] + aside] : [];
    const across = [Math.min(least(g.y) - 0.3 * body, ...way), Math.max(most(g.y) + 0.3 * body, ...way)];
    return {size, body, room, slider, end, guided, carried, along: [least(g.x) - 0.5 * body, far], across};
  }
  // One tall and narrow mechanism is laid down, its stroke to the right, and says so.
  function layDown(m, front) {
    const [g] = m.linkages, span = ([from, to]) => to - from;
    if (m.linkages.length !== 1 || Math.abs(Math.sin(g.direction)) < 0.99) return;
    const {along, across} = fieldOf(g, (front.force[0] || []).length > 0);
    if (span(along) > 2.5 * span(across)) Object.assign(g, {direction: 0, turned: true});
  }

  // The mechanism to scale: joints by table over the crank's angle, links as lines between them.
  function drawLinkage(m, g, which, front, ghosts, stage) {
    const own = front.force[which] || [];
    const c = Math.cos(g.direction), s = Math.sin(g.direction), jointAt = jointsOf(g);
    const {size, body, room, slider, end, guided, carried, along, across} = fieldOf(g, own.length > 0);
    const corners = along.flatMap(u => across.map(v => [u * c - v * s, -(u * s + v * c)]));
    const xs = corners.map(p => p[0]), ys = corners.map(p => p[1]);
    const w = Math.max(...xs) - Math.min(...xs), h = Math.max(...ys) - Math.min(...ys);
    const scale = 380 / Math.max(w, h), padding = 18;
    const bends = front.bend && front.bend[which] || [], bent = bends.length > 0;
    const firstShift = 2 * m.linkages.slice(0, which).reduce((sum, l) => sum + l.gaps.length, 0);
    const top = g.gaps.length ? 104 : bent ? 54 : g.turned ? 48 : 36;  // above all, the scale bar and the gaps
    const W = Math.max(w * scale + 2 * padding, 130, 150 * g.gaps.length), H = h * scale + padding + top;
    const X = (u, v) => (u * c - v * s - (Math.max(...xs) + Math.min(...xs)) / 2) * scale + W / 2;
    const Y = (u, v) => (-(u * s + v * c) - Math.min(...ys)) * scale + top;
    const svg = draw('svg', {viewBox: `0 0 ${W} ${H}`, role: 'img'}, stage);
    draw('title', {}, svg, `${g.name} to scale${g.turned ? ', turned by 90°' : ''}`);
    const at2 = (u, v) => `${X(u, v).toFixed(2)},${Y(u, v).toFixed(2)}`;
    // Guide, or the walls of a cylinder with its head, or a press with its table; fixed bearings, and a scale bar.
    if (slider) drawAround();
    function drawAround() {
      const low = Math.min(...g.x[guided]) - body, high = Math.max(...g.x[guided]) + body * 1.1, axis = g.y[guided][0];
      const line = (u1, v1, u2, v2, width) => draw('line', {x1: X(u1, v1), y1: Y(u1, v1), x2: X(u2, v2), y2: Y(u2, v2), stroke: 'var(--metal-edge)', 'stroke-width': width, 'stroke-linecap': 'round'}, svg);
      const half = body * 0.62, head = Math.max(...g.x[guided]) + body * 0.72;
      for (const v of [-1, 1]) line(low, axis + v * half, g.load === 'cylinder' ? head : high, axis + v * half, g.load === 'cylinder' ? 4 : 2);
      if (g.load === 'cylinder') line(head, axis - half, head, axis + half, 5);
      if (g.load === 'press') {
        const table = Math.max(...g.x[guided]) + body * 0.58 + 0.04 * size, wide = body * 1.05;
        draw('polygon', {points: [[table, -wide], [table, wide], [table + 0.35 * body, wide], [table + 0.35 * body, -wide]].map(([u, v]) => at2(u, axis + v)).join(' '), class: 'body'}, svg);
        draw('polygon', {points: [[table - 0.035 * size, -0.45 * body], [table - 0.035 * size, 0.45 * body], [table, 0.45 * body], [table, -0.45 * body]].map(([u, v]) => at2(u, axis + v)).join(' '), class: 'part'}, svg);
        for (const v of [-1, 1]) line(-0.4 * body, axis + v * wide * 1.08, table + 0.3 * body, axis + v * wide * 1.08, 5);
      }
    }
    for (const k of g.fixed) {
      const x = X(g.x[k][0], g.y[k][0]), y = Y(g.x[k][0], g.y[k][0]);
      draw('polygon', {points: `${x},${y} ${x - 9},${y + 14} ${x + 9},${y + 14}`, class: 'body'}, svg);
    }
    const round = Math.pow(10, Math.floor(Math.log10(70 / scale))), bar = round * (70 / scale / round >= 5 ? 5 : 70 / scale / round >= 2 ? 2 : 1);
    const captions = draw('g', {}, svg), said = [`${+(bar * 1000).toPrecision(3)} mm`];
    draw('line', {x1: 10, x2: 10 + bar * scale, y1: 14, y2: 14, stroke: 'var(--soft)', 'stroke-width': 2}, captions);
    if (g.name) said.push(g.name + (g.turned ? ', turned by 90°' : ''));
    if (bent) said.push(`rod bent × ${+g.bendEnlargement.toPrecision(3)}`);
    said.forEach((line, k) => draw('text', {x: 10, y: 19, dy: `${0.85 + 1.15 * k}em`, class: 'soft'}, captions, line));
    // Of large words the captions rise until they end above the mechanism.
    svg.raise = words => {
      const up = Math.max(0, 19 + (1.15 * said.length + 0.1) * 0.92 * words - top);
      place(captions, {transform: `translate(0 ${-up})`});
      svg.setAttribute('viewBox', `0 ${-up} ${W} ${H + up}`);
    };
    // A journal in its bearing for each gap, which is drawn as wide as a third of the bearing.
    const gaps = g.gaps.map((gap, k) => {
      const x = W - 76 - 150 * k, y = 42, wide = 12, R = 36;
      draw('circle', {cx: x, cy: y, r: R, class: 'dial'}, svg);
      draw('text', {x, y: y + R + 16, class: 'soft', 'text-anchor': 'middle'}, svg, `${gap.joint}, gap ${+(gap.size * 1000).toPrecision(3)} mm`);
      const journal = draw('circle', {r: R - wide, class: 'body'}, svg), centre = draw('circle', {r: 2.5, class: 'tie-end'}, svg);
      const shifts = [0, 1].map(axis => front.shift[firstShift + 2 * k + axis]);
      return at => {
        const [u, v] = shifts.map(list => at(list) / gap.size * wide);
        for (const shape of [journal, centre]) place(shape, {cx: x + u * c - v * s, cy: y - (u * s + v * c)});
      };
    });

    // A rectangle about a joint, along the direction of another or of the stroke.
    const block = (p, along, length, width) => {
      const [a, b] = along, points = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([i, j]) => [p[0] + i * length * a - j * width * b, p[1] + i * length * b + j * width * a]);
      return points.map(q => at2(...q)).join(' ');
    };
    const styles = {
      crank: {class: 'front', 'stroke-width': 7, 'stroke-linecap': 'round'}, link: {stroke: 'var(--metal-edge)', 'stroke-width': 9, 'stroke-linecap': 'round', 'stroke-linejoin': 'round'},
      slot: {stroke: 'var(--metal-edge)', 'stroke-width': 4, 'stroke-dasharray': '2 3'}, slider: {class: 'body'}, block: {class: 'body'},
    };
    // Half a sine wave between two joints, its middle moved across.
    function bentLine(a, b, bend) {
      const d = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1, across = [-(b[1] - a[1]) / d, (b[0] - a[0]) / d];
      return Array.from({length: 17}, (_, i) => [0, 1].map(k => a[k] + i / 16 * (b[k] - a[k]) + bend * Math.sin(Math.PI * i / 16) * across[k]));
    }
    function linkage(parent, ghost) {
      const ghostly = {class: 'ghost', 'stroke-width': 13, 'stroke-linecap': 'round', 'stroke-linejoin': 'round', opacity: 0.45};
      // The pin's circle, where the crank turns fully: the view of a crank that rocks ends at its arc.
      const radius = Math.hypot(g.x[1][0] - g.x[0][0], g.y[1][0] - g.y[0][0]), spread = list => Math.max(...list) - Math.min(...list);
      if (!ghost && Math.min(spread(g.x[1]), spread(g.y[1])) > 1.9 * radius) draw('circle', {cx: X(0, 0), cy: Y(0, 0), r: radius * scale, class: 'dial'}, parent);
      const parts = g.links.filter(link => link.shape !== 'point' && (!ghost || link.shape !== 'slot')).map(link => {
        const filled = link.shape === 'slider' || link.shape === 'block';
        return {link, filled, shape: draw(filled ? 'polygon' : 'polyline', {fill: 'none', ...(ghost ? ghostly : styles[link.shape])}, parent)};
      });
      const joints = ghost ? [] : g.x.map(() => draw('circle', {r: 4.5, class: 'dial'}, parent));
      return (angle, bend) => {
        const points = g.x.map((_, k) => jointAt(k, angle));
        for (const {link, filled, shape} of parts) {
          const [first, second] = link.joints.map(k => points[k]);
          if (!filled) place(shape, {points: (bend && link.shape === 'link' ? bentLine(first, second, bend) : link.joints.map(k => points[k])).map(q => at2(...q)).join(' ')});
          else if (link.shape === 'slider') place(shape, {points: block(first, [1, 0], body * 0.58, body * 0.58)});
          else {
            const d = Math.hypot(first[0] - second[0], first[1] - second[1]) || 1;
            place(shape, {points: block(first, [(first[0] - second[0]) / d, (first[1] - second[1]) / d], body * 0.36, body * 0.22)});
          }
        }
        joints.forEach((joint, k) => place(joint, {cx: X(...points[k]), cy: Y(...points[k])}));
        return points;
      };
    }
    const shadows = ghosts.map(() => linkage(svg, true));
    const main = linkage(svg, false);
    const largest = own.reduce((a, b) => Math.max(a, Math.abs(b)), 1e-12);
    const group = draw('g', {}, svg), arrow = draw('path', {class: 'arrow', 'stroke-width': 4, fill: 'none'}, group), head = draw('polygon', {class: 'head'}, group);
    const text = draw('text', {class: 'load', 'text-anchor': 'middle'}, group);
    // Beside the arrow's tail, away from its head, and within the view.
    function writeAt(tail, head) {
      const words = parseFloat(svg.style.getPropertyValue('--words')) || 13, half = 0.31 * words * text.textContent.length;
      const d = Math.hypot(tail[0] - head[0], tail[1] - head[1]) || 1, [u, v] = [0, 1].map(k => (tail[k] - head[k]) / d);
      const wanted = tail[0] + u * (half + 8), x = Math.min(Math.max(wanted, half + 4), W - half - 4), moved = Math.abs(x - wanted) > 4;
      const y = tail[1] + v * (0.6 * words + 6) + 0.35 * words - (moved && Math.abs(u) > 0.7 ? 0.8 * words + 8 : 0);
      place(text, {x, y: Math.min(Math.max(y, words), H - 4)});
    }
    return {svg, update};
    function update(at, loads) {
      const points = main(crankAngle(m, g, front, at), bent ? g.bendEnlargement * at(bends) : 0);
      gaps.forEach(show => show(at));
      ghosts.forEach((ghost, i) => shadows[i](crankAngle(m, g, ghost, at)));
      const force = at(own), shown = loads && Math.abs(force) > 1e-4 * largest;
      group.setAttribute('visibility', shown ? 'visible' : 'hidden');
      if (!shown) return;
      text.textContent = withPrefix(force, carried ? 'N' : 'N·m');
      if (carried) {
        // A push towards the crank ends at the slider's face, a pull begins there.
        const [x, y] = points[end], face = x + (guided === end && slider ? body * 0.58 : 0), point = 9 / scale;
        const length = (0.6 * room - point) * Math.abs(force) / largest, from = force < 0 ? face + point + length : face, to = force < 0 ? face + point : face + length;
        place(arrow, {d: `M${at2(from, y)} L${at2(to, y)}`});
        drawArrowHead(arrow, head, X(to, y), Y(to, y), g.direction + (force < 0 ? Math.PI : 0), 9);
        writeAt([X(from, y), Y(from, y)], [X(to, y), Y(to, y)]);
      } else {
        // About the rocker's bearing.
        const [u, v] = points[end], x = X(u, v), y = Y(u, v), R = 30, turn = 2.6 * force / largest, start = Math.PI / 2 - turn / 2, stop = start + turn;
        place(arrow, {d: `M${x + R * Math.cos(start)},${y - R * Math.sin(start)} A${R},${R} 0 0 ${turn > 0 ? 0 : 1} ${x + R * Math.cos(stop)},${y - R * Math.sin(stop)}`});
        drawArrowHead(arrow, head, x + R * Math.cos(stop), y - R * Math.sin(stop), stop + (turn > 0 ? 1 : -1) * Math.PI / 2, Math.abs(turn) < 0.08 ? 0 : 8);
        writeAt([x, y - R], [x, y]);
      }
    }
  }

  // --- two wheels in mesh ----------------------------------------------------------------------------------------------
  const svgNumber = value => +value.toPrecision(7);

  // Outline of a whole wheel in mm from its one pitch; y points down on the page.
  function wheelPath(wheel) {
    const points = [];
    for (let k = 0; k < wheel.teeth; ++k) {
      const c = Math.cos(2 * Math.PI * k / wheel.teeth), s = Math.sin(2 * Math.PI * k / wheel.teeth);
      wheel.x.forEach((x, i) => points.push(`${svgNumber(1e3 * (c * x - s * wheel.y[i]))},${svgNumber(-1e3 * (s * x + c * wheel.y[i]))}`));
    }
    const ring = r => `M${-r},0 A${r},${r} 0 1 0 ${r},0 A${r},${r} 0 1 0 ${-r},0 Z`;
    return `M${points.join(' L')} Z` + (wheel.edge ? ' ' + ring(1e3 * wheel.edge) : '');
  }

  function addGears(g, card) {
    card.classList.add('machine', 'gears');
    make('h3', '', g.title, make('header', '', null, card));
    const stage = make('div', 'stage', null, card);
    const reach = wheel => 1e3 * Math.max(wheel.edge, ...wheel.circles.map(c => c.radius));
    const left = Math.min(...g.wheels.map(w => 1e3 * w.centre - reach(w))), right = Math.max(...g.wheels.map(w => 1e3 * w.centre + reach(w))), high = Math.max(...g.wheels.map(reach));
    const margin = 0.03 * (right - left), close = 1e3 * g.closeUp, C = 1e3 * g.pitchPoint;
    const views = [
      drawMesh(g, stage, `${left - margin} ${-high - margin} ${right - left + 2 * margin} ${2 * (high + margin)}`, Math.max(right - left, 2 * high) + 2 * margin, false),
      drawMesh(g, stage, `${C - close} ${-close} ${2 * close} ${2 * close}`, 2 * close, true),
    ];
    // A tooth passes in a second and a half.
    const {slide, stop} = addControls(card, passed => show(angle + passed / 1500 * 2 * Math.PI / g.wheels[0].teeth));
    const [slider, shown] = slide(`angle of ${g.wheels[0].name}`, 360, 'angle');
    const legend = make('div', 'legend', null, card);
    for (const [name, text] of [['elastic', 'line of action, path of contact A … E'], ['vermillion', 'contacts'], ['reference', 'base circles'], ['green', 'working circles']])
      make('span', `plain-line is-${name}`, text, legend);
    if (g.note) make('p', 'note', g.note, card);
    let angle = 0;
    function show(value) {
      const turn = 2 * Math.PI;
      angle = (value % turn + turn) % turn;
      views.forEach(view => view(angle));
      slider.value = angle * 180 / Math.PI;
      shown.textContent = (angle * 180 / Math.PI).toFixed(1) + '°';
      card.dataset.angle = angle;
    }
    slider.oninput = () => { stop(); show(slider.value * Math.PI / 180); };
    show(0);
  }

  // One view of the mesh; `size` is the greater side of what is seen [mm]. Returns how to turn it.
  function drawMesh(g, stage, viewBox, size, close) {
    const svg = draw('svg', {viewBox, role: 'img', class: close ? 'close' : 'whole'}, stage);
    draw('title', {}, svg, close ? 'Mesh, enlarged' : 'Both wheels');
    const thin = 'non-scaling-stroke', px = size / 560;  // about one pixel
    const wheels = g.wheels.map(w => {
      const group = draw('g', {}, svg);
      draw('path', {d: wheelPath(w), class: w === g.wheels[0] ? 'body' : 'shaft', 'fill-rule': 'evenodd', 'vector-effect': thin}, group);
      // A mark that shows the turning.
      const inner = 1e3 * (w.internal ? Math.max(...w.circles.map(c => c.radius)) : w.edge), outer = 1e3 * (w.internal ? w.edge : Math.min(...w.circles.map(c => c.radius)));
      if (!close) draw('line', {x1: inner, x2: outer * (w.internal ? 1 : 0.9), y1: 0, y2: 0, stroke: 'var(--metal-edge)', 'stroke-width': 2, 'vector-effect': thin}, group);
      return {w, group};
    });
    for (const w of g.wheels) {
      const styles = {base: {stroke: 'var(--reference)', 'stroke-dasharray': '2 3'}, working: {stroke: 'var(--green)', 'stroke-dasharray': '9 3 2 3'}};
      for (const circle of w.circles)
        if (styles[circle.name]) draw('circle', {cx: 1e3 * w.centre, cy: 0, r: 1e3 * circle.radius, fill: 'none', 'stroke-width': 1, 'vector-effect': thin, ...styles[circle.name]}, svg);
    }
    const c = Math.cos(g.direction), s = Math.sin(g.direction);
    const at = place => [1e3 * (g.pitchPoint + place * c), -1e3 * place * s];
    const span = (from, to, attributes) => {
      const [x1, y1] = at(from), [x2, y2] = at(to);
      draw('line', {x1, y1, x2, y2, stroke: 'var(--elastic)', 'vector-effect': thin, ...attributes}, svg);
    };
    const ends = g.points.map(p => p.place), reach = Math.max(...ends.map(Math.abs), g.closeUp * 0.9);
    span(-reach, reach, {'stroke-width': 1});
    span(g.start, g.end, {'stroke-width': 3.5});
    // A name that would touch the one before it on its side stands on the other.
    const beside = {start: -Infinity, end: -Infinity};
    if (close) for (const p of [...g.points].sort((a, b) => a.place - b.place)) {
      const [x, y] = at(p.place);
      if (Math.abs(p.place) > 1.15 * g.closeUp) continue;
      draw('circle', {cx: x, cy: y, r: 2.2 * px, fill: 'var(--elastic)'}, svg);
      const isFree = side => 1e3 * p.place - beside[side] > 17 * px;
      const side = isFree('start') || beside.start < beside.end ? 'start' : 'end';
      beside[side] = 1e3 * p.place;
      draw('text', {x: x + (side === 'start' ? 7 : -7) * px, y: y + 4 * px, 'text-anchor': side, style: `font-size: ${15 * px}px; font-weight: 600`}, svg, p.name);
    }
    const most = Math.ceil((g.end - g.start) / g.basePitch) + 1;
    const contacts = Array.from({length: most}, () => draw('circle', {r: (close ? 5 : 4) * px, fill: 'var(--vermillion)'}, svg));
    return angle => {
      for (const {w, group} of wheels) place(group, {transform: `translate(${1e3 * w.centre} 0) rotate(${-(w.angle + w.speed * angle) * 180 / Math.PI})`});
      const first = g.firstContact + g.baseRadius * angle, lowest = first + Math.ceil((g.start - first) / g.basePitch) * g.basePitch;
      contacts.forEach((dot, k) => {
        const here = lowest + k * g.basePitch, [x, y] = at(here);
        place(dot, {cx: x, cy: y, visibility: here <= g.end ? 'visible' : 'hidden'});
      });
    };
  }

  // --- what "theory 3.2" means: a list at the foot, and words for those who point at a heading ---------------------------
  function addTheory(notes) {
    const list = make('ul', 'theory', null, root);
    for (const note of notes) make('li', '', note, list);
    const numberOf = note => note.slice('theory '.length, note.indexOf(':'));
    for (const heading of root.querySelectorAll('h1, h2, h3, summary, .subtitle')) {
      const cited = heading.textContent.match(/theory (\d+(\.\d+)?((, | and )\d+(\.\d+)?)*)/);
      if (cited) heading.title = notes.filter(note => cited[1].split(/, | and /).includes(numberOf(note))).join('\n');
    }
  }

  // --- the page --------------------------------------------------------------------------------------------------------
  if (report.brand || report.author) {
    const head = make('header', 'letterhead', null, root);
    if (report.brand) {  // as a picture: no script in it runs
      const logo = make('img', '', null, head);
      logo.src = 'data:image/svg+xml;charset=utf-8,' + encodeURIComponent(report.brand);
      logo.alt = report.author || 'logo';
    }
    if (report.author) make('span', '', report.author, head);
  }
  make('h1', '', report.title, root);
  if (report.subtitle) make('p', 'subtitle', report.subtitle, root);
  // A number and its unit stay on one line.
  report.conclusion = report.conclusion.map(sentence => sentence.replace(/(\d) (?=[%°a-zA-Zµ·²³\/]{1,9}(?:[\s,.;:)]|$))/g, '$1\u00a0'));
  if (report.conclusion.length) {
    const several = report.conclusion.length > 2;  // a list; else a paragraph
    const box = make(several ? 'ul' : 'p', 'conclusion' + (report.complete ? '' : ' incomplete'), several ? null : report.conclusion.join(' '), root);
    if (several) for (const sentence of report.conclusion) make('li', '', sentence, box);
  }
  const row = make('div', 'figures', null, root);
  for (const figure of report.figures) {
    const box = make('div', 'figure', null, row);
    const name = make('div', 'name', null, box);
    write(figure.name, figure.means ? meaningOf(figure.means, name) : name, true);
    const value = make('div', 'value', figure.value + ' ', box);
    make('span', 'unit', figure.unit, value);
    if (figure.error || figure.known) make('div', 'error', [figure.known, figure.error, figure.unit].filter(Boolean).join(' '), box);
    if (figure.note) make('div', 'note', figure.note, box);
  }
  const makers = {plot: addPlot, table: addTable, formula: addFormula, text: addText, machine: addMachine, gears: addGears};
  const machines = [];
  const titled = report.sections.filter(section => section.title);
  if (titled.length > 3) {
    const contents = make('nav', 'contents', null, root);
    make('span', '', 'Contents', contents);
    titled.forEach((section, i) => { make('a', '', section.title.replace(/ \(theory.*\)/, ''), contents).href = '#part-' + (i + 1); });
  }
  for (const section of report.sections) {
    if (section.title) make('h2', '', section.title, root).id = 'part-' + (titled.indexOf(section) + 1);
    const cards = make('div', 'cards', null, root);
    for (const card of section.cards) {
      const wide = card.kind === 'machine' || card.kind === 'gears' || card.wide || card.kind === 'table' && card.columns.length > 4 || section.cards.length === 1;
      const long = card.kind === 'table' && card.rows.length > 6 || card.kind === 'text';
      const element = make('section', 'card is-' + card.kind + (wide ? ' wide' : '') + (long ? ' long' : ''), null, cards);
      makers[card.kind](card, element);
    }
  }
  if (meanings.size) addMeanings();
  if (report.theory) addTheory(report.theory);
  make('footer', '', report.footer, root);
  requestAnimationFrame(() => setTimeout(drawInTurn, 0, 0));

  // At the foot of every printed page: which document it is of.
  const running = [report.title, report.subtitle].filter(Boolean).join(' — ');
  make('style', '', `@page { @bottom-left { content: ${JSON.stringify(running.length > 110 ? report.title.slice(0, 110) : running)}; font: 8pt sans-serif; color: #5a636e; } }`, document.head);

  // Colours follow the system; print is light and unfolded.
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', drawAll);
  // Before pages are made of it: what is opened later would not be counted, nor printed.
  let opened = null;
  function printing(on) {
    if (on === (opened !== null)) return;
    if (on) {
      opened = [...document.querySelectorAll('details:not([open]):not(.licence)')];
      opened.forEach(details => { details.open = true; });
    } else {
      opened.forEach(details => { details.open = false; });
      opened = null;
    }
    root.classList.toggle('printing', on);
    // A table that is wider than the paper gets smaller words, then words that break, then upright headings; numbers break last.
    for (const scroll of document.querySelectorAll('.scroll')) {
      const table = scroll.firstChild, wide = () => on && table.offsetWidth > scroll.clientWidth + 1;
      for (const [breaks, least] of [['', 6], ['breaks', 5], ['breaks heads', 5], ['breaks heads numbers', 4.5]]) {
        table.style.fontSize = '';
        table.className = breaks;
        for (let size = 7.5; wide() && size > least; size -= 0.25) table.style.fontSize = size + 'pt';
        if (!wide()) break;
      }
    }
    drawAll();
  }
  addEventListener('beforeprint', () => printing(true));
  addEventListener('afterprint', () => {
    printing(false);
    setTimeout(() => plots.forEach(({place, drawn}) => { if (drawn) Plotly.Plots.resize(place); }), 0);  // as wide as the page again
  });
})();
