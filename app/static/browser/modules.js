// Panel loads modules through this function of a shim, which fetches each a second time; browsers do it themselves.
/** @type {any} */ (window).importShim = Object.assign(
  (/** @type {string} */ url) => import(new URL(url, document.baseURI).href),
  { addImportMap() {} },
);
