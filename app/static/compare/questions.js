// Comparisons that are ready made: two settings of this impact, the first of which is kept.

/** @import { Frame, Question } from '../messages.js' */

const HEAVIER = 4;
const FASTER = 2;
const CLAMPED = [5, 10, 30]; // modes of a rod in a frame that is fixed to its struck end

/**
 * Those that can be asked of this impact, the most telling first.
 * @param {Frame} frame
 * @returns {Question[]}
 */
export function questionsOf(frame) {
  const { acting, chosen, kind } = frame;
  const ratio = Number(chosen.mass_ratio);
  const speed = Number(chosen.speed);
  /** @type {[key: string, name: string, first: number | string, second: number | string][]} */
  const all = [
    ['modes', 'modes', 5, 100],
    ['elements', 'elements', 10, 100],
    ['law', 'law', 'rigid', 'hertz'],
    ['hammer', 'mass_ratio', ratio, Math.max(ratio / HEAVIER, 1e-3)],
    ['constant', 'mass_ratio', Math.min(ratio * HEAVIER, 1e3), Math.max(ratio / HEAVIER, 1e-3)],
    ['speed', 'speed', speed, Math.min(FASTER * speed, 100)],
    ['theory', 'theory', 'euler-bernoulli', 'timoshenko'],
  ];
  if (kind === 'axial' && !frame.rods.length) all.splice(2, 1); // a rigid contact of rigid bodies takes no time
  if (kind === 'bodies')
    all.push(['restitution', 'restitution', 1, 0], ['off-centre', 'place', 0.5, Number(frame.own.place)]);
  /** @type {Question[]} */
  const found = all
    .filter(([, name, first, second]) => acting.includes(name) && first !== second)
    .map(([key, name, first, second]) => ({ question: key, first: { [name]: first }, second: { [name]: second } }));
  const { own } = frame;
  if (acting.includes('shapes'))
    found.unshift({ question: 'shapes', first: { shapes: 'pinned-free' }, second: { shapes: 'clamped-free' } });
  if (acting.includes('floating_frame') && own.floating_frame === 'attached')
    found.unshift({
      question: 'frame',
      first: { floating_frame: 'mean-axis' },
      second: { floating_frame: 'attached' },
    });
  if (acting.includes('floating_frame') && chosen.floating_frame === 'attached') {
    const [first, middle, second] = CLAMPED.map((modes) => ({ modes }));
    found.unshift({ question: 'clamped', first, between: [middle], second });
  }
  return [...found, ...frame.opens.compare];
}
