// Styles of the component, which lives in a shadow root; a later sheet wins over an earlier one. Paths from page.js.
import { alone } from './home.js';

export const SHEETS = [
  ...['lab', 'layout', 'controls', 'bodies', 'player', 'story', 'terms', 'help', 'phone'].map(
    (name) => `shell/${name}.css`,
  ),
  'charts/charts.css',
  'compare/compare.css',
  'space/stage.css',
  'beam/beam.css',
  ...['panel', 'record', 'plan', 'tradeoff', 'tolerance', 'stability', 'trust'].map((name) => `panels/${name}.css`),
  'opening/opening.css',
  'fall/lens.css',
  'opening/dock.css',
  ...(alone ? [] : ['shell/embedded.css']),
];
