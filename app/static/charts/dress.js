// Bokeh's plots in the type, the colours and the language of the page around them.
import { family } from '../text/catalogue.js';
import { localised } from '../text/format.js';

const TOOLS = family('chart.tool');
const SIZE = 12 / 14; // of the letters around
const NARROWEST = 335; // pixels of a plot whose legend has smaller letters
const SMALLER = 0.87;
export const NARROW = 480; // pixels of a plot whose legend has two columns, and whose title stands above it
const LEAST = 230; // pixels of the height of a plot
const LINE = 20; // pixels of a line of text above it, that may be still to come
const ENTRY = 180; // pixels of an entry of a legend, else

/**
 * @param {any} plot
 * @param {HTMLElement} place  where it is shown
 */
export function dress(plot, place) {
  const style = getComputedStyle(place);
  const of = (/** @type {string} */ name, /** @type {string} */ usual) => style.getPropertyValue(name).trim() || usual;
  const [ink, faint, line, panel] = [
    style.color,
    of('--faint', '#5b6c7d'),
    of('--line', '#dbe3ea'),
    of('--panel', '#fff'),
  ];
  const type = (/** @type {string} */ what, /** @type {string} */ color, share = 1) => ({
    [`${what}_text_font`]: style.fontFamily,
    [`${what}_text_font_size`]: `${share * SIZE * parseFloat(style.fontSize)}px`,
    [`${what}_text_font_style`]: 'normal',
    [`${what}_text_color`]: color,
  });
  for (const tool of plot.toolbar.tools) tool.description = TOOLS[tool.type] ?? tool.description;
  const narrow = place.clientWidth < NARROW;
  const pane = narrow ? null : place.closest('.lesson-charts .analysis'); // as high as the picture above it leaves it
  const room = pane ? pane.getBoundingClientRect().bottom - place.getBoundingClientRect().top - LINE : Infinity;
  plot.height = Math.min(plot.height, Math.max(room, LEAST));
  plot.title.visible = !narrow; // its tools would touch it: it stands above the plot
  plot.setv({ background_fill_color: panel, border_fill_color: panel, outline_line_color: line });
  plot.title.setv({ text_font: style.fontFamily, text_font_size: style.fontSize, text_color: ink });
  for (const part of [...plot.below, ...plot.left]) {
    if (part.formatter) localise(part.formatter);
    if ('axis_label' in part.properties) {
      part.setv({ ...type('axis_label', ink), ...type('major_label', faint), axis_label_standoff: 6 });
      part.setv({ axis_line_color: line, major_tick_line_color: line, minor_tick_line_color: null });
    } else if ('label_text_font' in part.properties) {
      const { clientWidth: wide } = place;
      const columns = narrow ? 2 : Math.floor(wide / ENTRY);
      part.setv({
        ...type('label', ink, wide < NARROWEST ? SMALLER : 1),
        ncols: columns,
        ...LEGEND,
        background_fill_color: null,
      });
    }
  }
  for (const part of plot.center) if ('grid_line_color' in part.properties) part.setv({ grid_line_color: line });
}

/**
 * Have it write numbers with the decimal sign of the language.
 * @param {any} formatter
 */
function localise(formatter) {
  const own = formatter.format_graphics.bind(formatter);
  formatter.format_graphics = (/** @type {any[]} */ ...given) => {
    const drawn = own(...given);
    for (const tick of drawn) {
      const words = tick.base ?? tick; // of a power of ten
      words.text = localised(words.text);
    }
    return drawn;
  };
}

const LEGEND = {
  location: [-50, 0], // from the left of the frame: below the numbers of the axis, too
  border_line_color: null,
  padding: 0,
  margin: 4,
  spacing: 8, // of columns, and of rows
  label_height: 12,
  glyph_height: 17, // or marks are too small to tell apart
};
