// The address of the page always says what is shown, and what is open and asked.

/** @import { Chosen } from './message.js' */
/** @import { Model } from './model.js' */

/**
 * @param {Model} model
 * @param {string[]} names
 * @param {Chosen} chosen
 */
export function queryOf(model, names, chosen) {
  const query = new URLSearchParams();
  const { spec } = model;
  const usual = chosen.scene === spec.scene.default;
  for (const name of names)
    if (name === 'scene' ? !usual : chosen[name] !== spec[name].default || !usual)
      query.set(name, String(chosen[name]));
  const { panels, asked } = model.shared;
  const open = Object.keys(panels).filter((name) => model[panels[name]]);
  if (open.length) query.set('panel', open.join(','));
  for (const [key, [name, panel, within]] of Object.entries(asked))
    if (open.includes(panel) && (!within || model.auto_within === within)) query.set(key, model[name]);
  return query.toString().replaceAll('%2C', ',');
}

/**
 * @param {Model} model
 * @param {string[]} names
 * @param {Chosen} chosen
 */
export function writeAddress(model, names, chosen) {
  const text = queryOf(model, names, chosen);
  history.replaceState(null, '', text ? `?${text}` : location.pathname);
}
