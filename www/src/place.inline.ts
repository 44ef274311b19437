// The compiled core inside the page, as base64, and the page's own script from the page.
import url from '../pkg/ringroad_bg.wasm?url&inline'

// `atob`, since fetching a data: address needs the policy `connect-src data:`, which few pages grant.
export const wasmBytes = async (): Promise<ArrayBuffer> =>
  Uint8Array.from(atob(url.slice(url.indexOf(',') + 1)), c => c.charCodeAt(0)).buffer

/** A classic worker from a blob: module workers from a blob fail in pages opened from disk. */
export const startWorker = (): Worker => {
  const script = document.querySelector('script[type=module]')?.textContent ?? ''
  return new Worker(URL.createObjectURL(new Blob([script], { type: 'text/javascript' })))
}
