// What the page needs of Bokeh, which keeps the connection.

/** @returns {any[]} documents of this page */
export const documents = () => /** @type {any} */ (window).Bokeh?.documents ?? [];
