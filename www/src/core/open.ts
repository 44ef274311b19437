// Starts the core: in a worker where that is allowed, else on the main thread.
import type { Start } from './protocol'
import { wasmBytes } from './assets'
import type { Client } from './client'
import { LocalClient } from './main_thread'
import { WorkerClient } from './worker_client'

export async function openCore(): Promise<{ client: Client; start: Start }> {
  const wasm = await wasmBytes('laboratory')
  try {
    const client = await WorkerClient.open()
    return { client, start: await client.ask('start', { wasm }) }
  } catch {
    const client = new LocalClient()
    return { client, start: await client.ask('start', { wasm }) }
  }
}
