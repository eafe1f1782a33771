// What is compared of impacts along one axis.
import { timesOf } from '../charts/peak.js';
import { averaged, pair } from '../charts/scale.js';
import { energies, figure } from '../compare/figure.js';
import { spansOf } from '../compare/histories.js';
import { listed, verdict } from '../compare/resolution.js';
import { given } from '../wire/message.js';
import { text } from '../text/catalogue.js';
import { engineering, percent, signed } from '../text/format.js';
import { forceOf } from './force.js';

/** @import { Samples } from '../charts/scale.js' */
/** @import { Histories } from '../compare/histories.js' */
/** @import { Compared } from '../compare/kinds.js' */
/** @import { AxialFigures, AxialFrame, Numbers } from '../messages.js' */

const EQUAL = 0.01; // difference of two mass ratios that is none
const GRAZING = 'near-grazing'; // the note that warns of the number of contacts

/**
 * @param {AxialFrame} frame
 * @param {'exact' | 'other'} which
 */
function figuresOf(frame, which) {
  const { exact, other, speed, trip } = frame;
  const solution = (which === 'other' && other) || exact;
  const { contacts } = solution;
  const [span, touching] = timesOf(contacts);
  return [
    figure('force', 'force', solution.peakForce),
    figure('apparent', 'time', contacts.length ? span * trip : null),
    figure('real', 'time', touching * trip),
    figure('contacts', 'count', contacts.length),
    figure(
      'impulse',
      'impulse',
      contacts.reduce((sum, [, , impulse]) => sum + impulse, 0),
    ),
    figure('rebound', 'velocity', solution.final === null ? null : solution.final * speed),
    figure('restitution', 'number', solution.restitution.newton),
    figure('indentation', 'length', solution.peakIndentation),
    ...energies(solution.energy),
  ];
}

/**
 * @param {Samples | null} samples
 * @param {number} x  factors
 * @param {number} y
 * @returns {Samples | null}
 */
const scaled = (samples, x, y) =>
  samples && {
    x: Float32Array.from(Array.from(samples.x), (value) => value * x),
    y: Float32Array.from(Array.from(samples.y), (value) => value * y),
  };

/**
 * @param {AxialFrame} frame
 * @returns {Samples | null}  the force of the other method, as its chart shows it
 */
function otherForce({ modalForce, other, otherForce: y, otherTime, step, trip }) {
  if (!modalForce || !other) return pair(otherTime, y);
  return averaged(modalForce, given(step, 'step'), given(other.diagnostics.resolved_time, 'resolved_time') / trip);
}

/**
 * @param {AxialFrame} frame
 * @param {'exact' | 'other'} which
 * @returns {Histories}
 */
function historiesOf(frame, which) {
  const { forceUnit, speed, trip } = frame;
  const exact = which === 'exact';
  const [impactor, struck] = exact ? [frame.exactMass, frame.exactEnd] : [frame.otherMass, frame.otherEnd];
  const path = (/** @type {Numbers | undefined} */ y) => scaled(pair(frame.motionTime, y), trip, speed * trip);
  const force = exact ? forceOf(frame) : otherForce(frame);
  return {
    force: scaled(force, trip, forceUnit),
    impactor: path(impactor),
    struck: path(struck),
    impactorRate: null,
    struckRate: null,
    contacts: spansOf(frame[which]?.contacts ?? [], trip),
  };
}

/** @param {AxialFigures} solution */
const impulseOf = ({ contacts }) => contacts.reduce((sum, [, , impulse]) => sum + impulse, 0);

/**
 * Of a method beside the exact solution.
 * @param {AxialFrame} now
 * @param {AxialFrame} kept
 * @param {string} name
 */
function ofResolution(now, kept, name) {
  const { contacts, final, peakForce, travelling } = now.exact;
  const misses = [kept, now].flatMap(({ chosen, other }) =>
    other?.peakForce && peakForce
      ? [
          {
            count: Number(chosen[name]),
            velocity: Math.abs((other.final ?? 0) - (final ?? 0)),
            impulse: Math.abs(impulseOf(other) / impulseOf(now.exact) - 1),
            force: Math.abs(other.peakForce / peakForce - 1),
            contacts: other.contacts.length,
          },
        ]
      : [],
  );
  if (misses.length < 2 || !peakForce) return '';
  misses.sort((a, b) => a.count - b.count);
  const jumps = now.rigid && now.rods.length > 0;
  const values = { contacts: contacts.length, velocity: signed(final ?? 0), force: engineering(peakForce, 'N') };
  const exact = text('compare.verdict.exact', { ...values, waves: travelling });
  const grazing = [now, kept].some((frame) => warnsOfCount(frame));
  const why = jumps && name === 'modes' ? [text('compare.verdict.jumps', { grazing })] : [];
  const first = verdict(misses, contacts.length, name, jumps, grazing);
  return [first, ...why, exact, listed(misses, name, grazing)].join(' ');
}

/**
 * Whether a warning stands beside it not to trust the number of contacts.
 * @param {AxialFrame} frame
 */
const warnsOfCount = ({ exact, other }) =>
  [exact, other].some((each) => (each?.notes ?? []).some(({ code }) => code === GRAZING));

/**
 * What another support of the far end changes.
 * @param {AxialFrame} now
 * @param {AxialFrame} kept
 */
function ofSupport(now, kept) {
  const [fixed, free] = [kept, now].map(({ target }) => target.support === 'fixed');
  if (!fixed || free || now.exact.final === null) return '';
  const { energy, final } = now.exact;
  const waves = percent((energy.target_vibration ?? 0) / energy.initial);
  const equal = Math.abs(Number(now.chosen.mass_ratio) - 1) < EQUAL;
  return text('compare.verdict.support', { equal, velocity: signed(final), waves });
}

/** @type {Compared} */
export const compared = {
  trips: true,
  figures: figuresOf,
  histories: historiesOf,
  contacts: (/** @type {AxialFrame} */ { exact }) => exact.contacts,
  law: (/** @type {AxialFrame} */ frame) => frame,
  peakForce: (/** @type {AxialFrame} */ { exact }) => exact.peakForce,
  resolution: ofResolution,
  verdicts: { scene: ofSupport },
};
