//! The paper's flow of 1668 vehicles an hour at 25 vehicles a kilometre: which change of its values would give it?

use ringroad::scenario::driver::Driver;

/// Prints the flow at several densities, the densities with a flow of 1668, and each value of the paper's table that
/// would have to change.
pub fn main() {
    let driver = Driver::default();
    let q = |rho: f64| 3600.0 * driver.flow(rho / 1000.0);
    println!("| density (veh/km) | flow by the paper's formula and table (veh/h) |\n|---|---|");
    for rho in [10.0, 12.5, 15.0, 20.0, 25.0, 30.0, 50.0] {
        println!("| {rho} | {:.1} |", q(rho));
    }
    // Bisection on the rising and on the falling branch.
    let solve = |mut low: f64, mut high: f64| {
        let rising = q(high) > q(low);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if (q(middle) < 1668.0) == rising { low = middle } else { high = middle }
        }
        low
    };
    println!(
        "\n1668 veh/h is the flow at {:.3} and at {:.2} veh/km.\n",
        solve(1.0, 33.0),
        solve(34.0, 133.0)
    );
    println!("| one value of the table changed, at 25 veh/km | to give 1668 veh/h |\n|---|---|");
    let find = |set: fn(&mut Driver, f64), low: f64, high: f64| {
        let flow = |x: f64| {
            let mut d = driver;
            set(&mut d, x);
            3600.0 * d.flow(0.025)
        };
        let rising = flow(high) > flow(low);
        let (mut a, mut b) = (low, high);
        for _ in 0..100 {
            let m = 0.5 * (a + b);
            if (flow(m) < 1668.0) == rising { a = m } else { b = m }
        }
        a
    };
    println!("| λ = 1 /s | {:.3} /s |", find(|d, x| d.sensitivity = x, 0.1, 2.0));
    println!("| V = 40 m/s | {:.2} m/s |", find(|d, x| d.max_speed = x, 5.0, 60.0));
    println!("| d = 7.5 m | {:.2} m |", find(|d, x| d.min_headway = x, 0.1, 39.0));
}
