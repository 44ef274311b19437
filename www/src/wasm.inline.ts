// The compiled core inside the page, as base64. `atob`, since fetching a data: address needs the policy
// `connect-src data:`, which few pages grant.
import url from '../pkg/ringroad_bg.wasm?url&inline'

export const wasmBytes = async (): Promise<ArrayBuffer> =>
  Uint8Array.from(atob(url.slice(url.indexOf(',') + 1)), c => c.charCodeAt(0)).buffer
