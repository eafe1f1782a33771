// Panel loads modules through this function of a shim, which fetches each a second time; browsers do it themselves.
window.importShim = Object.assign((url) => import(new URL(url, document.baseURI).href), { addImportMap() {} });
