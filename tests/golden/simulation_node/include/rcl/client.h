#error "The component 'services' is not selected: add `components: [+services]` to microros.yaml and generate again"
