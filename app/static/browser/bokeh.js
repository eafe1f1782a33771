// What the page needs of Bokeh, which keeps the connection.

/** @returns {any} BokehJS */
export const bokeh = () => /** @type {any} */ (window).Bokeh;

/** @returns {any[]} documents of this page */
export const documents = () => bokeh()?.documents ?? [];
