// The question that a scene asks: its own as long as nothing of it is changed, else that of its kind.
import { changesOf } from '../form/settings.js';
import { family } from '../text/catalogue.js';

/** @import { Frame } from '../messages.js' */

const OF = family('opening.of');

/**
 * What a scene asks as it is; nothing of most.
 * @param {unknown} scene
 */
export const ownQuestion = (scene) => OF[String(scene)] ?? '';

/**
 * @param {Frame} frame
 * @param {{ question: (frame: any) => string }} story  of its kind
 */
export const questionOf = (frame, story) =>
  (changesOf(frame) ? '' : ownQuestion(frame.chosen.scene)) || story.question(frame);
