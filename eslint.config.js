import js from '@eslint/js';
import handlers from './eslint.handlers.js';
import texts from './eslint.texts.js';

const BROWSER = [
  ...['CompressionStream', 'DecompressionStream', 'Response', 'atob', 'btoa'],
  ...['window', 'document', 'location', 'history', 'navigator', 'performance', 'fetch', 'console'],
  ...['setTimeout', 'clearTimeout', 'clearInterval', 'AbortSignal', 'requestAnimationFrame', 'cancelAnimationFrame'],
  ...[
    'MediaRecorder',
    'AbortController',
    'MutationObserver',
    'ResizeObserver',
    'matchMedia',
    'Node',
    'NodeFilter',
    'PointerEvent',
    'Element',
    'Event',
    'EventTarget',
    'HTMLElement',
    'IntersectionObserver',
    'URL',
    'URLSearchParams',
    'Blob',
    'Worker',
    'File',
    'Image',
  ],
  ...['TextDecoder', 'TextEncoder', 'WebAssembly', 'XMLSerializer', 'getComputedStyle'],
];

export default [
  { ignores: ['.venv/', 'build/', 'app/packed/'] },
  js.configs.recommended,
  {
    files: ['app/static/**/*.js'],
    languageOptions: { globals: Object.fromEntries(BROWSER.map((name) => [name, 'readonly'])) },
    plugins: { handlers, texts },
    rules: { 'handlers/silent': 'error', 'texts/catalogued': 'error' },
  },
  {
    files: ['tests/js/**/*.js'],
    languageOptions: {
      globals: {
        Buffer: 'readonly',
        Event: 'readonly',
        EventTarget: 'readonly',
        performance: 'readonly',
        TextEncoder: 'readonly',
      },
    },
  },
  {
    files: ['tests/**/*.mjs'],
    languageOptions: { globals: { WebAssembly: 'readonly', console: 'readonly', process: 'readonly' } },
  },
  {
    rules: {
      eqeqeq: 'error',
      'max-len': ['error', { code: 120 }],
      'max-lines': ['error', 400],
      'max-lines-per-function': ['error', 60],
      'no-shadow': 'error',
      'no-unused-vars': ['error', { argsIgnorePattern: '^_' }],
      'no-var': 'error',
      'one-var': ['error', 'never'],
      'object-shorthand': 'error',
      'prefer-const': ['error', { destructuring: 'all' }],
    },
  },
];
