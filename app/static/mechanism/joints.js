// The joints of a mechanism on the stage, and arrows of what they bear.
import { COLORS } from '../charts/styles.js';
import { GROUND } from '../text/words.js';

/** @import { JointRecord } from '../messages.js' */
/** @import { Context, Point } from './mechanism.js' */

const PIN = 4.5; // pixels

/**
 * @param {Context} c
 * @param {JointRecord} joint
 * @param {Point} place
 */
export function drawJoint(c, joint, [x, y]) {
  if (joint.links.includes(GROUND)) ground(c, joint, x, y);
  if (joint.kind === 'prismatic') slide(c, joint, x, y);
  c.fillStyle = joint.driven ? COLORS.modal : '#fff';
  c.strokeStyle = '#33475b';
  c.lineWidth = 1.6;
  c.beginPath();
  if (joint.kind === 'fixed') c.rect(x - PIN, y - PIN, 2 * PIN, 2 * PIN);
  else c.arc(x, y, PIN, 0, 7);
  c.fill();
  c.stroke();
}

/**
 * @param {Context} c
 * @param {JointRecord} joint
 * @param {number} x
 * @param {number} y
 */
function ground(c, joint, x, y) {
  if (joint.kind === 'prismatic') return;
  c.strokeStyle = '#8a97a3';
  c.fillStyle = '#d4dce4';
  c.lineWidth = 1.2;
  c.beginPath();
  c.moveTo(x, y);
  c.lineTo(x - 9, y + 15);
  c.lineTo(x + 9, y + 15);
  c.closePath();
  c.fill();
  c.stroke();
  c.beginPath();
  c.moveTo(x - 14, y + 15);
  c.lineTo(x + 14, y + 15);
  for (let s = -10; s <= 14; s += 7) {
    c.moveTo(x + s, y + 15);
    c.lineTo(x + s - 5, y + 21);
  }
  c.stroke();
}
/**
 * The guide of a sliding joint.
 * @param {Context} c
 * @param {JointRecord} joint
 * @param {number} x
 * @param {number} y
 */
function slide(c, { axis }, x, y) {
  const [across, up] = axis ?? [1, 0];
  const length = Math.hypot(across, up) || 1;
  const [dx, dy] = [across / length, -up / length];
  c.strokeStyle = '#8a97a3';
  c.lineWidth = 1.4;
  for (const side of [-9, 9]) {
    c.beginPath();
    c.moveTo(x - 26 * dx - side * dy, y - 26 * dy + side * dx);
    c.lineTo(x + 26 * dx - side * dy, y + 26 * dy + side * dx);
    c.stroke();
  }
}
