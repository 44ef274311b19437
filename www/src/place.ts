// What lies beside the page: the compiled core, and the script for the worker. The one-file page takes
// place.inline.ts instead: the build replaces the name '../place', so only files one folder down may import it.
import url from '../pkg/ringroad_bg.wasm?url'

export const wasmBytes = async (): Promise<ArrayBuffer> => {
  const response = await fetch(url)
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`)
  return response.arrayBuffer()
}

/** A worker that runs the page's own script. */
export const startWorker = (): Worker => new Worker(import.meta.url, { type: 'module' })
