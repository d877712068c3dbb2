"""What every widget shares: traits, requests, threads, what travels to the browser."""
