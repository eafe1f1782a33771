// What the page knows of a view of impacts of one kind.

/** @import { Axis } from '../charts/axis.js' */
/** @import { Chart } from '../charts/chart.js' */
/** @import { Cycle } from '../axial/cycle.js' */
/** @import { Gauge, Source } from '../charts/gauge.js' */
/** @import { Supports } from '../charts/supports.js' */
/** @import { Reactions } from '../mechanism/reactions.js' */
/** @import { Dispersion } from '../beam/charts.js' */
/** @import { Second } from '../compare/beside.js' */
/** @import { Scaled } from '../compare/scales.js' */
/** @import { Scene } from '../opening/section.js' */
/** @import { Run } from '../clock/player.js' */
/** @import { Stack } from './stack.js' */
/** @import { Events } from './story.js' */
/** @import { Striker } from './striker.js' */

/**
 * What shows an impact of one kind.
 * @typedef {object} View
 * @property {Scaled & Picture} stage
 * @property {Story} story
 * @property {number} after  an event, by which what it has changed is seen
 * @property {string[]} [leading]  choices that lead there before others
 * @property {(frame: any) => Run} clock  what is played
 * @property {(frame: any) => boolean} [hangs]  whether what strikes does, from a pivot
 * @property {HTMLElement[]} buttons  beside the caption
 * @property {Axis} [axis]  of time
 * @property {number} [leastRoom]  about what is looked at closely, as a share of the whole impact
 * @property {number} [linkUnit]  in which links count its times; 1 by default
 * @property {{ root: HTMLElement }} [colours]  the choice of what they show
 * @property {Stack} [stack]  charts over time
 * @property {Chart} [strip]  the one of them that the opening shows where it has no rows
 * @property {Scene | null} [section]  what the opening draws over place and time, below the stage
 * @property {HTMLElement} [lens]  what the opening shows closer, below the names of events
 * @property {Cycle} [cycle]
 * @property {Gauge} [gauge]
 * @property {Supports} [supports]
 * @property {Reactions} [reactions]
 * @property {(place: number) => void} [gaugeAt]  move it to another place [m]
 * @property {(frame: any, room?: string) => Source[]} [read]  as a gauge reads its solutions; in a room beside others
 * @property {Dispersion} [dispersion]
 * @property {() => void} dress  pictures in their colours and to their scale
 * @property {string} [what]  that the colours show
 * @property {string} [usual]  that they show at first
 * @property {string[]} [whats]  that they can show
 * @property {(what: any) => void} [colour]  have them show it
 * @property {(hidden: boolean) => void} hide
 * @property {(frame: any) => void} load
 * @property {() => void} [refine]  after histories of the frame have become finer
 * @property {() => void} draw
 * @property {(t: number) => void} show
 * @property {() => { names: string[], values: number[][] }} [rows]  histories as a table, if there are any
 */

/**
 * What is asked of a kind of impact, whichever view has the page.
 * @typedef {object} Kind
 * @property {(frame: any, exact?: string) => Restitution} restitution  `exact`: the method beside all others
 * @property {(frame: any) => Second} beside  a kept solution
 * @property {(frame: any, record: Measured | null) => void} [overlay]  a measured force, or none
 */
/** @typedef {{ time: number[], force: number[] }} Measured  [s, N] */
/**
 * What its slider does; whether it sets nothing but a prediction.
 * @typedef {{ note: string, predicts?: boolean }} Restitution
 */

/**
 * @typedef {object} Picture
 * @property {HTMLElement} root
 * @property {HTMLCanvasElement} canvas
 * @property {Striker | null} striker
 * @property {boolean} [leads]  whether the opening has the page
 * @property {HTMLElement | null} [lap]  what lies over its lower right
 */

/**
 * What is said of it.
 * @typedef {object} Story
 * @property {HTMLElement} [energy]  where it is in the end
 * @property {HTMLElement} root  in words
 * @property {HTMLElement} numbers
 * @property {Events} events
 * @property {(frame: any) => string} question  the one that it asks
 * @property {(frame: any) => void} load
 * @property {(t: number) => void} at
 */

export {};
