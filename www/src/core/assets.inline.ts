// For the one-file page: the compiled modules of the core are in the page, as base64, and the worker runs the page's own
// script. The build uses it instead of assets.ts.
import figuresUrl from '../../pkg-figures/figures_bg.wasm?url&inline'
import laboratoryUrl from '../../pkg/ringroad_bg.wasm?url&inline'
import * as figuresModule from './figures'

const urls = { laboratory: laboratoryUrl, figures: figuresUrl }

// `atob`, since fetching a data: address needs the policy `connect-src data:`, which few pages grant.
export const wasmBytes = async (module: keyof typeof urls): Promise<ArrayBuffer> => {
  const url = urls[module]
  return Uint8Array.from(atob(url.slice(url.indexOf(',') + 1)), c => c.charCodeAt(0)).buffer
}

/** A classic worker from a blob: module workers from a blob fail in pages opened from disk. */
export const startWorker = (): Worker => {
  const script = document.querySelector('script[type=module]')?.textContent ?? ''
  return new Worker(URL.createObjectURL(new Blob([script], { type: 'text/javascript' })))
}

/** Without `import()`: the build turns that into code that a classic worker may not run. */
export const figures = async () => figuresModule
