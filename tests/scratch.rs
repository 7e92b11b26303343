use ahv::flight::Flight;
use ahv::linear::Linear;
#[test]
fn scratch() {
    let mut f = Flight::new().unwrap();
    f.initialise().unwrap();
    let t = f.trim().unwrap();
    println!("{:?}", t);
    let l = Linear::new(f.vehicle().unwrap(), &t.state, &t.control);
    println!("{:?}\n{:?}", l.poles(), l.zeros());
    f.set_input(0, 0.01);
    for i in 1..=100 {
        f.advance(i as f64 * 0.01).unwrap();
    }
    f.evaluate().unwrap();
    println!("{:?}", f.sample());
    println!("{:?} {}", f.state(), ahv::variables::guid());
    for i in 101..=500 {
        if let Err(e) = f.advance(i as f64 * 0.01) {
            println!("{e}");
            break;
        }
    }
}
#[test]
fn modes() {
    use ahv::variables::find;
    for c in 1..=3 {
        let mut f = Flight::new().unwrap();
        find("configuration").unwrap().set(&mut f, c as f64).unwrap();
        let t0 = std::time::Instant::now();
        f.initialise().unwrap();
        println!("{:?}", t0.elapsed());
        let t = f.trim().unwrap();
        let v = f.vehicle().unwrap();
        println!("{c} {:?}\n{:?} m {} I {} x {}", t, v.omega, v.mass, v.inertia, v.mass_centre);
        println!("{:?}", v.elastic.lift);
        let l = Linear::new(f.vehicle().unwrap(), &t.state, &t.control);
        for p in l.poles() {
            println!("   {:.6} {:.6}", p.re, p.im)
        }
        println!("zeros");
        for p in l.zeros() {
            println!("   {:.6} {:.6}", p.re, p.im)
        }
    }
}
